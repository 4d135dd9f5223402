// What the doctor makes of facts: each trouble is a problem with a remedy, and a healthy host has none.
#include "clients/bleedctl/doctor.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "idl/bleed.h"
#include "service/transport/receive_buffer.h"

namespace bleedsim::bleedctl {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kVersions = "versions";
constexpr const char* kNetwork = "network";
constexpr const char* kBuffer = "receive buffer";
constexpr const char* kTime = "time";
constexpr const char* kDomain = "domain";
constexpr const char* kSessions = "sessions";

SessionFacts healthySession() {
  SessionFacts session;
  session.status.name = "theatre";
  session.status.host = "here";
  session.status.version = "1.0.0";
  session.status.state = client::SessionState::running;
  session.status.real_time_factor = 1.0;
  session.status.frame_rate_hz = 60.0;
  session.scene.emplace();
  session.scene->protocol_major = bleed_v1_PROTOCOL_MAJOR;
  session.scene->protocol_minor = bleed_v1_PROTOCOL_MINOR;
  session.scene->capacity = 1000;
  session.round_trip_s = 1e-4;
  session.difference = ClockDifference{0.0, 5e-5};
  session.frame_came = true;
  session.particle_bytes = 28;
  return session;
}

DoctorFacts healthy() {
  DoctorFacts facts;
  facts.host = "here";
  facts.config.emplace();
  facts.config->interface = "lo";
  facts.interfaces = {{"lo", true, true}, {"eth7", false, true}};
  facts.receive_limit = 212'992;
  facts.clock = ClockState{true, 0.01};
  facts.sessions = {healthySession()};
  return facts;
}

/// The findings of that severity and area, each with its remedy.
std::string found(const DoctorFacts& facts, Severity severity, const std::string& area) {
  std::string text;
  for (const Finding& finding : diagnose(facts)) {
    if (finding.severity == severity && finding.area == area) text += finding.text + " -> " + finding.remedy + "\n";
  }
  return text;
}
std::string problems(const DoctorFacts& facts, const std::string& area) { return found(facts, Severity::problem, area); }
std::string notes(const DoctorFacts& facts, const std::string& area) { return found(facts, Severity::note, area); }

class DoctorTest : public testing::Test {
 protected:
  /// There is exactly this one problem, and something to do about it.
  void expectOnly(const std::string& area, const testing::Matcher<std::string>& text) {
    std::size_t count = 0;
    for (const Finding& finding : diagnose(facts_)) {
      if (finding.severity != Severity::problem) continue;
      ++count;
      EXPECT_EQ(finding.area, area) << finding.text;
      EXPECT_THAT(finding.text, text);
      EXPECT_FALSE(finding.remedy.empty()) << finding.text;
    }
    EXPECT_EQ(count, 1U);
  }
  client::SessionStatus& status() { return facts_.sessions.front().status; }

  DoctorFacts facts_ = healthy();
};

TEST_F(DoctorTest, FindsNothingWrongWhereNothingIs) {
  for (const Finding& finding : diagnose(facts_)) EXPECT_NE(finding.severity, Severity::problem) << finding.text;
  for (const char* area : {kVersions, kNetwork, kBuffer, kTime, kDomain, kSessions}) {
    EXPECT_NE(found(facts_, Severity::ok, area), "") << area;
  }
}

TEST_F(DoctorTest, FindsAnotherMinorVersionWorthANote) {
  facts_.sessions[0].scene->protocol_minor = bleed_v1_PROTOCOL_MINOR + 1;
  EXPECT_THAT(notes(facts_, kVersions), HasSubstr("install the same version on both sides"));
  EXPECT_EQ(problems(facts_, kVersions), "");
}

TEST_F(DoctorTest, FindsAProgramOfAnotherMajorVersion) {
  facts_.others.endpoints.push_back({{}, true, true, "bleed/v7/status", {"theatre"}});
  expectOnly(kVersions, HasSubstr("bleed/v7/status"));
}

TEST_F(DoctorTest, FindsADomainThatCannotBeJoined) {
  facts_.domain_problem = "there is no network interface 'eth9'";
  facts_.config.reset();
  facts_.sessions.clear();
  expectOnly(kNetwork, HasSubstr("eth9"));
}

TEST_F(DoctorTest, FindsAnInterfaceThatTheUsersConfigurationReplaces) {
  facts_.config->kind = transport::ConfigKind::user;
  facts_.asked_interface = "eth7";
  expectOnly(kNetwork, HasSubstr("CYCLONEDDS_URI replaces it"));
}

TEST_F(DoctorTest, SaysThatLoopbackSeesThisHostOnly) {
  EXPECT_THAT(notes(facts_, kNetwork), AllOf(HasSubstr("nothing leaves this host"), HasSubstr("--interface NAME")));
  EXPECT_THAT(found(facts_, Severity::ok, kNetwork), AllOf(HasSubstr("lo (loopback), eth7"), HasSubstr("loopback only")));
}

TEST_F(DoctorTest, FindsAReceiveBufferThatTwoFullFramesDoNotFit) {
  facts_.sessions[0].scene->capacity = 3804;  // 2 x 3804 x 28 B = 213 024 B, just over the 212 992 B
  expectOnly(kBuffer, HasSubstr("two frames of this scene at full capacity need 213 kB"));
  EXPECT_THAT(problems(facts_, kBuffer),
              AllOf(HasSubstr("sysctl -w net.core.rmem_max=67108864"), HasSubstr("/etc/sysctl.d keeps it")));
  facts_.sessions[0].scene->capacity = 3803;
  EXPECT_EQ(problems(facts_, kBuffer), "");
}

TEST_F(DoctorTest, TakesTheUsualParticleForAFrameThatDidNotCome) {
  facts_.sessions[0].particle_bytes = 0;
  facts_.sessions[0].scene->capacity = 3804;
  EXPECT_THAT(problems(facts_, kBuffer), HasSubstr("with the usual 28 B a particle"));
}

TEST_F(DoctorTest, SaysForHowManyParticlesTheBufferIsEnoughWithoutASession) {
  facts_.sessions.clear();
  EXPECT_THAT(notes(facts_, kBuffer), HasSubstr("enough for frames of 3803 particles"));
  facts_.receive_limit = transport::kReceiveBufferBytes;
  EXPECT_EQ(notes(facts_, kBuffer), "");
  facts_.receive_limit = 0;
  EXPECT_THAT(notes(facts_, kBuffer), HasSubstr("cannot be read"));
}

TEST_F(DoctorTest, AnUnsynchronisedClockMattersBetweenHostsOnly) {
  facts_.clock->synchronised = false;
  EXPECT_EQ(problems(facts_, kTime), "");
  EXPECT_THAT(notes(facts_, kTime), HasSubstr("not synchronised"));
  status().host = "there";
  expectOnly(kTime, HasSubstr("not synchronised"));
}

TEST_F(DoctorTest, FindsADaemonWhoseClockIsOff) {
  facts_.sessions[0].difference = ClockDifference{-3.5, 0.001};
  status().host = "there";
  expectOnly(kTime, AllOf(HasSubstr("on there is 3.500000 s behind ours"), HasSubstr("to 0.001000 s")));
  facts_.sessions[0].difference = ClockDifference{3.5, 3.45};
  EXPECT_EQ(problems(facts_, kTime), "") << "it may be off by less than matters";
}

TEST_F(DoctorTest, NotesOtherVendors) {
  facts_.others.members.push_back({{}, transport::kOwnVendor, "here", "bleedd", 7});
  facts_.others.members.push_back({{}, 0x010f, "there", "rviz2", 8});
  EXPECT_THAT(notes(facts_, kDomain), AllOf(HasSubstr("rviz2 (pid 8) on there takes part with Fast DDS"), HasSubstr("tested")));
  EXPECT_THAT(found(facts_, Severity::ok, kDomain), HasSubstr("bleedd (pid 7) on here"));
}

TEST_F(DoctorTest, NotesWhoeverWaitsForASessionThatDoesNotRun) {
  facts_.others.endpoints = {{{}, true, true, "bleed/v1/request", {"theatre"}},
                             {{}, true, true, "bleed/v1/request", {"theater"}},
                             {{}, false, true, "bleed/v1/status", {"*"}},
                             {{}, false, true, "rt/chatter", {"other"}}};
  EXPECT_EQ(
      notes(facts_, kDomain),
      "somebody waits for session 'theater', which does not run here -> start bleedd --session theater, or correct the name\n");
}

TEST_F(DoctorTest, CountsTheWritersAndReadersOfWhoeverTakesPart) {
  EXPECT_THAT(found(facts_, Severity::ok, kDomain), HasSubstr("nobody else takes part"));
  facts_.others.members.push_back({{}, transport::kOwnVendor, "here", "bleedd", 7});
  facts_.others.endpoints = {{{}, true, true, "bleed/v1/frame", {"theatre"}},
                             {{}, true, true, "bleed/v1/status", {"theatre"}},
                             {{}, false, true, "bleed/v1/request", {"theatre"}}};
  EXPECT_THAT(found(facts_, Severity::ok, kDomain), HasSubstr("their writers: 2, their readers: 1"));
}

TEST_F(DoctorTest, CountsTheReadersOfFrames) {
  facts_.others.endpoints = {{{}, false, true, "bleed/v1/frame", {"theatre"}},
                             {{}, false, false, "bleed/v1/frame", {"theatre"}},
                             {{}, false, false, "bleed/v1/frame", {"other"}},
                             {{}, true, true, "bleed/v1/frame", {"theatre"}}};
  EXPECT_THAT(found(facts_, Severity::ok, kSessions), HasSubstr("its frames go to 2 others, 1 of them reliably"));
}

TEST_F(DoctorTest, FindsASolverThatStopped) {
  status().state = client::SessionState::faulted;
  status().text = "the solver stopped: particle 7 is not finite";
  expectOnly(kSessions, HasSubstr("particle 7 is not finite"));
  EXPECT_THAT(problems(facts_, kSessions), HasSubstr("bleedctl --session theatre reset"));
}

TEST_F(DoctorTest, FindsASessionThatDoesNotAnswer) {
  facts_.sessions[0].round_trip_s.reset();
  expectOnly(kSessions, HasSubstr("does not answer commands"));
}

TEST_F(DoctorTest, FindsFramesThatDoNotArrive) {
  facts_.sessions[0].frame_came = false;
  expectOnly(kSessions, HasSubstr("its frames do not arrive here"));
  status().frame_rate_hz = 1.0;
  EXPECT_EQ(problems(facts_, kSessions), "") << "there may just have been none";
  status().frame_rate_hz = 60.0;
  status().state = client::SessionState::paused;
  EXPECT_EQ(problems(facts_, kSessions), "");
}

TEST_F(DoctorTest, FindsASessionThatFallsBehind) {
  status().behind_s = 4.0;
  status().real_time_factor = 0.4;
  expectOnly(kSessions, HasSubstr("4.0 s behind"));
  status().real_time_factor = 1.2;
  EXPECT_EQ(problems(facts_, kSessions), "") << "it catches up";
  status().real_time_factor = 0.4;
  status().pace = client::PaceMode::factor;
  status().pace_factor = 0.4;
  EXPECT_EQ(problems(facts_, kSessions), "") << "it keeps the pace that was asked for";
  status().pace = client::PaceMode::maximum;
  EXPECT_EQ(problems(facts_, kSessions), "");
}

TEST_F(DoctorTest, NotesWarningsAndLosses) {
  status().text = "surface_tension below support_ratio 2.5";
  status().counters = {{"journal_lost", 3}, {"requests", 9}, {"write_failures", 0}};
  EXPECT_THAT(notes(facts_, kSessions), AllOf(HasSubstr("support_ratio 2.5"), HasSubstr("3 inputs that the journal"),
                                              testing::Not(HasSubstr("middleware"))));
  EXPECT_EQ(problems(facts_, kSessions), "");
}

TEST_F(DoctorTest, EveryLossHasARemedyOfItsOwn) {
  status().counters = {
      {"journal_lost", 1}, {"replies_lost", 1}, {"write_failures", 1}, {"requests_busy", 1}, {"instruments_dropped", 1}};
  std::set<std::string> remedies;
  for (const Finding& finding : diagnose(facts_)) {
    if (finding.severity == Severity::note && finding.area == std::string{kSessions}) remedies.insert(finding.remedy);
  }
  EXPECT_EQ(remedies.size(), 5U);
  EXPECT_FALSE(remedies.contains(""));
}

TEST_F(DoctorTest, WhateverIsFoundComesWithWhatToDoAndNamesNothingThatOnlyTheSourcesHave) {
  std::vector<DoctorFacts> all;
  const auto with = [&](auto change) { change(all.emplace_back(healthy())); };
  with([](DoctorFacts& facts) {
    facts.sessions[0].scene.reset();
    facts.receive_limit = 0;
    facts.clock.reset();
    facts.sessions[0].status.text = "wetting: off";
    facts.sessions[0].status.counters = {{"journal_lost", 1}, {"instruments_dropped", 1}};
  });
  with([](DoctorFacts& facts) {
    facts.sessions[0].scene->protocol_minor = 9;
    facts.sessions[0].scene->capacity = 1'000'000'000;
    facts.clock->synchronised = false;
    facts.sessions[0].round_trip_s.reset();
    facts.others.members.push_back({{}, 0x010f, "there", "rviz2", 8});
    facts.others.endpoints = {{{}, true, true, "bleed/v1/request", {"theater"}}, {{}, true, true, "bleed/v7/status", {"a"}}};
    facts.sessions.push_back(healthySession());
  });
  with([](DoctorFacts& facts) {
    facts.sessions[0].status.host = "there";
    facts.sessions[0].difference = ClockDifference{9.0, 0.001};
    facts.clock->synchronised = false;
    facts.sessions[0].frame_came = false;
  });
  with([](DoctorFacts& facts) { facts.sessions.clear(); });
  with([](DoctorFacts& facts) {
    facts.sessions.clear();
    facts.asked_session = "theatre";
    facts.config->kind = transport::ConfigKind::user;
    facts.asked_interface = "eth7";
  });
  with([](DoctorFacts& facts) { facts.domain_problem = "no interface"; });
  std::size_t count = 0;
  for (const DoctorFacts& facts : all) {
    for (const Finding& finding : diagnose(facts)) {
      EXPECT_THAT(finding.remedy, testing::Not(HasSubstr("config/")));
      if (finding.severity == Severity::ok) continue;
      ++count;
      EXPECT_FALSE(finding.remedy.empty()) << finding.text;
    }
  }
  EXPECT_GT(count, 18U);
}

TEST_F(DoctorTest, FindsTwoDaemonsOfOneName) {
  facts_.sessions.push_back(healthySession());
  expectOnly(kSessions, HasSubstr("two daemons run a session 'theatre'"));
}

TEST_F(DoctorTest, AMissingSessionIsAProblemIfItWasAskedFor) {
  facts_.sessions.clear();
  EXPECT_EQ(problems(facts_, kSessions), "");
  EXPECT_THAT(notes(facts_, kSessions), HasSubstr("no session was found"));
  facts_.asked_session = "theatre";
  expectOnly(kSessions, HasSubstr("session 'theatre' was not found"));
}

// Two hosts that started at different times: 100 s and 7 s before by their own clocks of the day, which differ by 2 s.
TEST(ClockDifferenceTest, IsThatOfTheClocksOfTheDay) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::int64_t kDay = 1'700'000'000 * kSecond;
  client::SessionStatus status;
  status.monotonic_stamp_ns = 100 * kSecond;
  status.realtime_stamp_ns = kDay + 2 * kSecond;
  // The status is half a second old when our clocks are read.
  const std::int64_t own_monotonic = 7 * kSecond + kSecond / 2;
  const std::int64_t own_day = kDay + kSecond / 2;
  const client::ClockOffset offset{93 * kSecond, 4'000'000, 1};
  const ClockDifference difference = clockDifference(status, offset, own_monotonic, own_day);
  EXPECT_DOUBLE_EQ(difference.ahead_s, 2.0);
  EXPECT_DOUBLE_EQ(difference.uncertainty_s, 0.002);
}

TEST(ClockStateTest, IsToldByTheKernel) {
  const auto state = readClockState();
  if (!state) GTEST_SKIP() << "the kernel does not tell here";
  EXPECT_GE(state->max_error_s, 0.0);
}

}  // namespace
}  // namespace bleedsim::bleedctl
