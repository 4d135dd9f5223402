// What the doctor makes of the facts: one function an area.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <string_view>

#include "clients/bleedctl/doctor.h"
#include "idl/bleed.h"
#include "service/transport/names.h"
#include "service/transport/receive_buffer.h"

namespace bleedsim::bleedctl {
namespace {

// A frame of the shipped scenes: position, id and velocity.
constexpr std::size_t kUsualParticleBytes = 28;
// Real time that was missed by less may be a moment's affair.
constexpr double kBehindLimit = 0.5;
// A trainer's log and a daemon's are compared by eye.
constexpr double kClockLimit = 0.1;

using Findings = std::vector<Finding>;

/// Adds findings of one area.
class Area {
 public:
  Area(Findings& findings, const char* name) : findings_{findings}, name_{name} {}
  void ok(std::string text) { findings_.push_back({Severity::ok, name_, std::move(text), {}}); }
  void note(std::string text, std::string remedy) {
    findings_.push_back({Severity::note, name_, std::move(text), std::move(remedy)});
  }
  void problem(std::string text, std::string remedy) {
    findings_.push_back({Severity::problem, name_, std::move(text), std::move(remedy)});
  }

 private:
  Findings& findings_;
  const char* name_;
};

std::string memberText(const transport::DomainMember& member) {
  return fmt::format("{} (pid {}) on {}", member.process.empty() ? "a program" : member.process, member.pid,
                     member.host.empty() ? "an unknown host" : member.host);
}

bool elsewhere(const DoctorFacts& facts, const SessionFacts& session) { return session.status.host != facts.host; }

void findVersions(const DoctorFacts& facts, Area area) {
  area.ok(fmt::format("bleedctl {}, protocol {}.{}, Cyclone DDS {}", facts.version, bleed_v1_PROTOCOL_MAJOR,
                      bleed_v1_PROTOCOL_MINOR, facts.dds_version));
  for (const SessionFacts& session : facts.sessions) {
    const client::SessionStatus& status = session.status;
    if (!session.scene) {
      area.note(fmt::format("session '{}': bleedd {}, its scene did not come", status.name, status.version),
                "look below at what is said of the session; if it answers and this lasts, compare versions: 'bleedd --version'");
      continue;
    }
    const std::string text = fmt::format("session '{}': bleedd {} ({}), protocol {}.{}", status.name, status.version,
                                         session.scene->build_id, session.scene->protocol_major, session.scene->protocol_minor);
    if (session.scene->protocol_minor == bleed_v1_PROTOCOL_MINOR) {
      area.ok(text);
    } else {
      area.note(text + ": it and this bleedctl work together, but one of them lacks what the other has newly",
                "install the same version on both sides");
    }
  }
  std::set<std::string> foreign;
  const std::string prefix = fmt::format("bleed/v{}/", bleed_v1_PROTOCOL_MAJOR);
  for (const transport::DomainEndpoint& endpoint : facts.others.endpoints) {
    if (endpoint.topic.starts_with("bleed/v") && !endpoint.topic.starts_with(prefix)) foreign.insert(endpoint.topic);
  }
  if (!foreign.empty()) {
    area.problem(fmt::format("a program of another protocol version is on the domain (topics {})", fmt::join(foreign, ", ")),
                 "install tools and daemon of the same major version");
  }
}

void findNetwork(const DoctorFacts& facts, Area area) {
  if (!facts.domain_problem.empty()) {
    area.problem(facts.domain_problem, "mend what it names; 'ip address' lists interfaces, 'env | grep DDS' the configuration");
  }
  if (facts.config) {
    area.ok(fmt::format("domain {}, DDS uses {}", facts.domain, transport::describe(*facts.config)));
    if (facts.config->kind == transport::ConfigKind::user && !facts.asked_interface.empty()) {
      area.problem(fmt::format("--interface {} is not used: CYCLONEDDS_URI replaces it", facts.asked_interface),
                   "unset CYCLONEDDS_URI, or name the interface in that configuration");
    }
    if (facts.config->kind == transport::ConfigKind::loopback && facts.asked_interface.empty()) {
      area.note("nothing leaves this host: sessions of other hosts are not seen",
                "if there should be any, give --interface NAME, here and to bleedd");
    }
  }
  std::vector<std::string> names;
  for (const transport::NetworkInterface& interface : facts.interfaces) {
    names.push_back(interface.name + (interface.loopback ? " (loopback)" : interface.up ? "" : " (down)"));
  }
  area.ok(fmt::format("interfaces with an IPv4 address: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

void findReceiveBuffer(const DoctorFacts& facts, Area area) {
  if (facts.receive_limit == 0) {
    area.note(
        "net.core.rmem_max cannot be read",
        fmt::format("in a container it may be hidden: see on the host that 'sysctl net.core.rmem_max' gives {} or what frames "
                    "need",
                    transport::kReceiveBufferBytes));
    return;
  }
  const std::size_t granted = std::min(facts.receive_limit, transport::kReceiveBufferBytes);
  for (const SessionFacts& session : facts.sessions) {
    if (!session.scene) continue;
    const bool known = session.particle_bytes > 0;
    const std::size_t frame = session.scene->capacity * (known ? session.particle_bytes : kUsualParticleBytes);
    const std::string name = fmt::format("session '{}'{}", session.status.name, known ? "" : " (with the usual 28 B a particle)");
    if (const auto shortage = transport::findShortage(facts.receive_limit, frame)) {
      area.problem(fmt::format("{}: {}", name, shortage->text), shortage->remedy);
    } else {
      area.ok(fmt::format("{}: {} kB, two full frames need {} kB", name, granted / 1000, 2 * frame / 1000));
    }
  }
  if (!facts.sessions.empty()) return;
  const std::string text =
      fmt::format("{} kB of the {} kB that bleedsim asks for", granted / 1000, transport::kReceiveBufferBytes / 1000);
  if (granted == transport::kReceiveBufferBytes) {
    area.ok(text);
  } else {
    area.note(text + fmt::format(": enough for frames of {} particles", granted / 2 / kUsualParticleBytes),
              fmt::format("for larger ones, the line net.core.rmem_max={} in a .conf file in /etc/sysctl.d, then sysctl --system",
                          transport::kReceiveBufferBytes));
  }
}

void findTime(const DoctorFacts& facts, Area area) {
  const auto on_other_host = [&](const SessionFacts& session) { return elsewhere(facts, session); };
  const bool hosts_differ = std::any_of(facts.sessions.begin(), facts.sessions.end(), on_other_host);
  const std::string remedy = "run a time service, as chrony or systemd-timesyncd, on every host";
  if (!facts.clock) {
    area.note("the kernel does not tell whether the clock is synchronised",
              "'timedatectl' or 'chronyc tracking' may; it matters once trainers and daemons are on several hosts");
  } else if (facts.clock->synchronised) {
    area.ok(fmt::format("this host's clock is synchronised, to {:.3f} s at worst", facts.clock->max_error_s));
  } else if (hosts_differ) {
    area.problem("this host's clock is not synchronised, and sessions run on other hosts: their stamps do not fit ours", remedy);
  } else {
    area.note("this host's clock is not synchronised", "it matters once trainers and daemons are on several hosts: " + remedy);
  }
  for (const SessionFacts& session : facts.sessions) {
    if (!session.difference) continue;
    const auto [ahead, uncertainty] = *session.difference;
    const std::string text = fmt::format("the clock of session '{}' on {} is {:.6f} s {} ours, to {:.6f} s", session.status.name,
                                         session.status.host, std::abs(ahead), ahead < 0.0 ? "behind" : "ahead of", uncertainty);
    if (std::abs(ahead) > kClockLimit + uncertainty) {
      area.problem(text, remedy);
    } else {
      area.ok(text);
    }
  }
}

bool readsFrames(const transport::DomainEndpoint& endpoint, const std::string& session) {
  if (endpoint.writer || endpoint.topic != transport::topicName(transport::Topic::frame)) return false;
  return std::any_of(endpoint.partitions.begin(), endpoint.partitions.end(),
                     [&](const std::string& partition) { return partition == session || partition == transport::kAnySession; });
}

void findMembers(const DoctorFacts& facts, Area area) {
  std::vector<std::string> own;
  for (const transport::DomainMember& member : facts.others.members) {
    if (member.vendor == transport::kOwnVendor) {
      own.push_back(memberText(member));
    } else {
      area.note(fmt::format("{} takes part with {}", memberText(member), transport::vendorName(member.vendor)),
                "bleedsim was tested with Cyclone DDS only");
    }
  }
  if (facts.others.members.empty()) area.ok("nobody else takes part");
  if (!own.empty()) area.ok(fmt::format("takes part: {}", fmt::join(own, ", ")));
  std::size_t writers = 0;
  for (const transport::DomainEndpoint& endpoint : facts.others.endpoints) writers += endpoint.writer ? 1 : 0;
  if (!facts.others.members.empty()) {
    area.ok(fmt::format("their writers: {}, their readers: {}", writers, facts.others.endpoints.size() - writers));
  }
}

/// Partitions of our topics that no session has.
void findWaiting(const DoctorFacts& facts, Area area) {
  std::set<std::string> awaited;
  for (const transport::DomainEndpoint& endpoint : facts.others.endpoints) {
    if (!endpoint.topic.starts_with("bleed/v")) continue;
    for (const std::string& partition : endpoint.partitions) {
      if (transport::validSessionName(partition)) awaited.insert(partition);
    }
  }
  for (const SessionFacts& session : facts.sessions) awaited.erase(session.status.name);
  for (const std::string& name : awaited) {
    area.note(fmt::format("somebody waits for session '{}', which does not run here", name),
              fmt::format("start bleedd --session {}, or correct the name", name));
  }
}

std::string stateText(const DoctorFacts& facts, const SessionFacts& session) {
  const client::SessionStatus& status = session.status;
  std::size_t readers = 0;
  std::size_t reliable = 0;
  for (const transport::DomainEndpoint& endpoint : facts.others.endpoints) {
    if (!readsFrames(endpoint, status.name)) continue;
    ++readers;
    if (endpoint.reliable) ++reliable;
  }
  const std::string frames = readers == 0 ? std::string{"nobody else reads its frames"}
                                          : fmt::format("its frames go to {} others, {} of them reliably", readers, reliable);
  return fmt::format("'{}' on {} (pid {}) is {}: {:.1f} s simulated, real-time factor {:.2f}, {} particles; {}", status.name,
                     status.host, status.pid, client::toString(status.state), status.sim_time_s, status.real_time_factor,
                     status.particles, frames);
}

void findLosses(const client::SessionStatus& status, Area& area) {
  struct Loss {
    std::string_view counter;
    const char* meaning;
    const char* remedy;
  };
  constexpr std::array<Loss, 5> kLosses{
      {{"journal_lost", "inputs that the journal had no room for: recordings of it cannot be replayed",
        "send fewer inputs a second; a reset begins an epoch whose recordings can be replayed"},
       {"replies_lost", "replies that found no room",
        "send fewer commands a second; the client library asks again by itself, other clients must repeat a request that gets "
        "none"},
       {"write_failures", "samples that the middleware did not take",
        "look into its log, and at memory and network of its host: a reliable reader that hangs holds it up"},
       {"requests_busy", "commands refused because the queue was full",
        "wait for a reply before the next command; 'bleedctl status' tells which client sends how many"},
       {"instruments_dropped", "instrument samples that were not used",
        "stream each tool once, at no more than 1 kHz and with a rising seq, and end tools that rest; 'bleedctl status' tells "
        "whose they are"}}};
  for (const auto& [name, value] : status.counters) {
    const auto loss = std::find_if(kLosses.begin(), kLosses.end(), [&name = name](const Loss& l) { return l.counter == name; });
    if (value > 0 && loss != kLosses.end())
      area.note(fmt::format("'{}': {} {} so far", status.name, value, loss->meaning), loss->remedy);
  }
}

/// Frames should come much faster than the doctor waits, and none did.
bool lacksFrames(const SessionFacts& session) {
  constexpr double kSurelyOften = 10.0;
  const client::SessionStatus& status = session.status;
  const bool often = status.frame_rate_hz * status.real_time_factor > kSurelyOften;
  return status.state == client::SessionState::running && often && !session.frame_came;
}

void findSession(const DoctorFacts& facts, const SessionFacts& session, Area& area) {
  const client::SessionStatus& status = session.status;
  const std::string text = stateText(facts, session);
  const double wanted = status.pace == client::PaceMode::factor ? status.pace_factor : 1.0;
  const bool paced = status.pace != client::PaceMode::maximum && status.state == client::SessionState::running;
  if (status.state == client::SessionState::faulted) {
    area.problem(fmt::format("{}; {}", text, status.text),
                 fmt::format("bleedctl --session {0} reset, or load another scene", status.name));
  } else if (!session.round_trip_s) {
    area.problem(text + "; it does not answer commands",
                 "if this lasts, look into its log; its host may be overloaded, or a firewall may let through only one way");
  } else if (lacksFrames(session)) {
    area.problem(text + "; its frames do not arrive here",
                 "see 'receive buffer' above; between hosts, a firewall must let UDP through in both directions");
  } else if (paced && status.behind_s > kBehindLimit && status.real_time_factor < 0.97 * wanted) {
    area.problem(fmt::format("{}; it is {:.1f} s behind and does not catch up", text, status.behind_s),
                 "a coarser spacing_m, a shorter scene, fewer other programs, or a pace that it can keep: bleedctl pace X");
  } else {
    area.ok(fmt::format("{}; answers in {:.2f} ms", text, *session.round_trip_s * 1e3));
  }
  if (!status.text.empty() && status.state != client::SessionState::faulted)
    area.note(fmt::format("'{}': {}", status.name, status.text),
              "'bleedd --scene FILE --list-effects' explains it; change the scene where it is not what you want");
  findLosses(status, area);
}

void findSessions(const DoctorFacts& facts, Area area) {
  std::set<std::string> names;
  for (const SessionFacts& session : facts.sessions) {
    findSession(facts, session, area);
    if (names.insert(session.status.name).second) continue;
    area.problem(fmt::format("two daemons run a session '{}'", session.status.name),
                 "they settle it by themselves within seconds; if not, end one of them");
  }
  const std::string remedy =
      "start bleedd; if it runs, compare its domain, interface and tag with ours: its log says at the start what DDS uses";
  if (!facts.asked_session.empty() && !names.contains(facts.asked_session)) {
    area.problem(fmt::format("session '{}' was not found", facts.asked_session), remedy);
  } else if (facts.sessions.empty()) {
    area.note("no session was found", remedy);
  }
}

}  // namespace

const char* toString(Severity severity) {
  switch (severity) {
    case Severity::ok:
      return "ok";
    case Severity::note:
      return "note";
    case Severity::problem:
      break;
  }
  return "problem";
}

std::vector<Finding> diagnose(const DoctorFacts& facts) {
  Findings findings;
  findVersions(facts, {findings, "versions"});
  findNetwork(facts, {findings, "network"});
  findReceiveBuffer(facts, {findings, "receive buffer"});
  findTime(facts, {findings, "time"});
  if (facts.domain_problem.empty()) {
    findMembers(facts, {findings, "domain"});
    findWaiting(facts, {findings, "domain"});
    findSessions(facts, {findings, "sessions"});
  }
  return findings;
}

}  // namespace bleedsim::bleedctl
