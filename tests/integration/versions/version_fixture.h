// A session whose two ends are of different minor versions: what both must be able to do. Compiled once against each contract.
#pragma once

#include <cstdint>
#include <string>

#include "tests/integration/service/probe.h"

namespace bleedsim::versions_test {

class VersionFixture : public service_test::ServiceTest {
 protected:
  /// Samples of every topic the daemon writes, heard by this end's contract.
  void hearEveryTopic(const std::string& session);
  /// Commands of several kinds and an instrument, told through the client library; the session's state follows.
  void commandThroughTheLibrary(const std::string& session, std::uint32_t minor_of_daemon);
  /// A request that the daemon does not know is refused by its number, and the session goes on.
  void askForTheUnknown(const std::string& session, std::uint32_t kind, const service_test::Probe::Body& fill);
};

}  // namespace bleedsim::versions_test
