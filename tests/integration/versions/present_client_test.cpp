// The present client and a daemon of the next minor version.
#include "tests/integration/versions/version_fixture.h"

namespace bleedsim::versions_test {
namespace {

class PresentClientNextDaemon : public VersionFixture {};

TEST_F(PresentClientNextDaemon, HearEachOtherOnEveryTopic) { hearEveryTopic("next"); }

TEST_F(PresentClientNextDaemon, TheLibraryCommands) { commandThroughTheLibrary("next", bleed_v1_PROTOCOL_MINOR + 1); }

TEST_F(PresentClientNextDaemon, AnUnknownRequestIsAnsweredUnsupported) { askForTheUnknown("next", 99, {}); }

}  // namespace
}  // namespace bleedsim::versions_test
