// Reads what the doctor wants to know.
#include <algorithm>
#include <unistd.h>

#include "bleedsim/client.h"
#include "clients/bleedctl/doctor.h"
#include "service/transport/clock.h"
#include "service/transport/domain.h"
#include "service/transport/host_name.h"
#include "service/transport/participant.h"
#include "service/transport/receive_buffer.h"

namespace bleedsim::bleedctl {
namespace {

// Peers announce themselves every second.
constexpr std::chrono::milliseconds kListenWindow{1500};
constexpr std::chrono::seconds kAnswerTime{2};
constexpr std::chrono::seconds kFrameTime{2};
constexpr int kPings = 5;
constexpr std::size_t kMaxQuestioned = 32;

std::size_t particleBytes(const client::Frame& frame) {
  if (frame.count() == 0) return 0;
  const std::size_t floats = frame.positions().size() + frame.velocities().size() + frame.radii().size() +
                             frame.platelets().size() + frame.viscosities().size() + frame.densities().size();
  return (floats * sizeof(float) + frame.ids().size() * sizeof(std::uint32_t)) / frame.count();
}

void question(client::Client& client, SessionFacts& facts) {
  Result<client::Session> session = client.open(facts.status.name, {}, kAnswerTime);
  if (!session) return;
  for (int i = 0; i < kPings; ++i) {
    const Result<std::chrono::nanoseconds> round_trip = session->ping(kAnswerTime);
    if (!round_trip) break;
    const double seconds = std::chrono::duration<double>{*round_trip}.count();
    facts.round_trip_s = std::min(facts.round_trip_s.value_or(seconds), seconds);
  }
  const auto newest = [&facts](const client::SessionStatus& status) { return status.session == facts.status.session; };
  if (const Result<client::SessionStatus> status = session->waitStatus(newest, kAnswerTime)) facts.status = *status;
  if (const std::optional<client::ClockOffset> offset = session->clockOffset()) {
    facts.difference = clockDifference(facts.status, *offset, transport::monotonicNow(), transport::realtimeNow());
  }
  if (const Result<client::SceneInfo> scene = session->waitScene(kAnswerTime)) facts.scene = *scene;
  if (const Result<client::FramePointer> frame = session->waitFrame(kFrameTime)) {
    facts.frame_came = true;
    facts.particle_bytes = particleBytes(**frame);
  }
}

void leaveOut(transport::DomainView& view, const std::string& host, std::int32_t pid) {
  const auto own = [&](const transport::DomainMember& member) { return member.host == host && member.pid == pid; };
  const auto of_own = [&](const transport::DomainEndpoint& endpoint) {
    return std::any_of(view.members.begin(), view.members.end(),
                       [&](const auto& member) { return own(member) && member.guid == endpoint.member; });
  };
  std::erase_if(view.endpoints, of_own);
  std::erase_if(view.members, own);
}

void lookAtDomain(const Context& context, DoctorFacts& facts) {
  const auto participant = transport::Participant::create(
      {.domain = context.connection.domain, .interface = context.connection.interface, .tag = context.connection.tag});
  if (!participant) {
    facts.domain_problem = participant.status().message();
    return;
  }
  const auto observer = transport::DomainObserver::create(*participant);
  Result<client::Client> client = client::Client::create(context.connection);
  if (!observer || !client) {
    facts.domain_problem = observer ? client.status().message() : observer.status().message();
    return;
  }
  for (client::SessionStatus& status : client->listSessions(kListenWindow))
    facts.sessions.emplace_back().status = std::move(status);
  const std::size_t questioned = std::min(facts.sessions.size(), kMaxQuestioned);
  for (std::size_t i = 0; i < questioned; ++i) question(*client, facts.sessions[i]);
  facts.others = observer->view();
  leaveOut(facts.others, facts.host, getpid());
}

}  // namespace

DoctorFacts gatherFacts(const Context& context) {
  DoctorFacts facts;
  facts.version = BLEEDSIM_VERSION;
  facts.dds_version = transport::middlewareVersion();
  facts.host = transport::hostName();
  facts.domain = context.connection.domain;
  facts.asked_interface = context.connection.interface;
  facts.asked_session = context.session;
  facts.interfaces = transport::listInterfaces();
  facts.receive_limit = transport::receiveBufferLimit();
  facts.clock = readClockState();
  const auto config = transport::chooseConfig(
      {.domain = context.connection.domain, .interface = context.connection.interface, .tag = context.connection.tag});
  if (config) facts.config = *config;
  lookAtDomain(context, facts);
  return facts;
}

}  // namespace bleedsim::bleedctl
