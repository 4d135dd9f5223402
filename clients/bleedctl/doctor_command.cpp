// doctor: what is wrong on this host and domain, and what to do.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fmt/core.h>
#include <map>
#include <string>

#include "clients/bleedctl/doctor.h"
#include "clients/bleedctl/json.h"

namespace bleedsim::bleedctl {
namespace {

constexpr const char* kDoctorText =
    "Looks for some seconds at versions, network, the kernel's receive buffer, clocks, and all that takes part in the domain.\n"
    "Each line is ok, a note or a problem; what helps follows an arrow. Exit code 0: nothing is wrong, 1: there are "
    "problems.\n\n";

std::string jsonText(const DoctorFacts& facts, const std::vector<Finding>& findings, std::size_t problems) {
  JsonArray found;
  for (const Finding& finding : findings) {
    JsonObject one;
    one.add("severity", toString(finding.severity)).add("area", finding.area).add("text", finding.text);
    found.raw(one.add("remedy", finding.remedy).text());
  }
  JsonArray interfaces;
  for (const transport::NetworkInterface& interface : facts.interfaces) {
    JsonObject one;
    one.add("name", interface.name).add("loopback", interface.loopback);
    interfaces.raw(one.add("up", interface.up).text());
  }
  JsonArray sessions;
  for (const SessionFacts& session : facts.sessions) {
    JsonObject one;
    one.add("session", session.status.name).add("state", client::toString(session.status.state));
    one.add("version", session.status.version).add("host", session.status.host).add("pid", session.status.pid);
    if (session.round_trip_s) one.add("round_trip_s", *session.round_trip_s);
    if (session.difference) one.add("clock_ahead_s", session.difference->ahead_s);
    sessions.raw(one.text());
  }
  JsonArray members;
  for (const transport::DomainMember& member : facts.others.members) {
    JsonObject one;
    one.add("vendor", transport::vendorName(member.vendor)).add("process", member.process).add("host", member.host);
    members.raw(one.add("pid", member.pid).text());
  }
  std::map<std::string, std::array<std::uint64_t, 2>> topics;  // writers and readers
  for (const transport::DomainEndpoint& endpoint : facts.others.endpoints) ++topics[endpoint.topic][endpoint.writer ? 0 : 1];
  JsonObject topics_json;
  for (const auto& [topic, counts] : topics) {
    JsonObject one;
    topics_json.raw(topic, one.add("writers", counts[0]).add("readers", counts[1]).text());
  }
  JsonObject json;
  json.add("host", facts.host).add("domain", facts.domain).add("version", facts.version).add("dds_version", facts.dds_version);
  json.add("dds_config", facts.config ? transport::describe(*facts.config) : std::string{});
  json.add("receive_buffer_limit_bytes", std::uint64_t{facts.receive_limit});
  if (facts.clock) json.add("clock_synchronised", facts.clock->synchronised);
  json.raw("interfaces", interfaces.text()).raw("members", members.text()).raw("sessions", sessions.text());
  json.raw("topics", topics_json.text());
  return json.raw("findings", found.text()).add("problems", std::uint64_t{problems}).text();
}

void printFindings(const DoctorFacts& facts, const std::vector<Finding>& findings, std::size_t problems) {
  fmt::print("host {}, domain {}\n", facts.host, facts.domain);
  const char* area = "";
  for (const Finding& finding : findings) {
    if (std::strcmp(area, finding.area) != 0) fmt::print("{}\n", finding.area);
    area = finding.area;
    const std::string severity = finding.severity == Severity::problem ? "PROBLEM" : toString(finding.severity);
    fmt::print("  {:<7}  {}\n", severity, finding.text);
    if (!finding.remedy.empty()) fmt::print("           -> {}\n", finding.remedy);
  }
  if (problems == 0) {
    fmt::print("nothing is wrong\n");
  } else {
    fmt::print("{} problem{}\n", problems, problems == 1 ? "" : "s");
  }
}

int runDoctor(const Context& context) {
  const DoctorFacts facts = gatherFacts(context);
  const std::vector<Finding> findings = diagnose(facts);
  const auto is_problem = [](const Finding& finding) { return finding.severity == Severity::problem; };
  const auto problems = static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_problem));
  if (context.json) {
    fmt::print("{}\n", jsonText(facts, findings, problems));
  } else {
    printFindings(facts, findings, problems);
  }
  return problems == 0 ? kDone : kFailed;
}

}  // namespace

void addDoctorCommand(CLI::App& app, Context& context) {
  CLI::App* doctor = app.add_subcommand("doctor", "Look for what is wrong on this host and domain, and say what to do");
  doctor->footer(kDoctorText + doctor->get_footer());
  doctor->callback([&context] { context.action = [&context] { return runDoctor(context); }; });
}

}  // namespace bleedsim::bleedctl
