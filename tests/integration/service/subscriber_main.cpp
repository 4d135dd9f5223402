// Reads the frames and the journal of a session for ever, as a recorder does: service_subscriber DOMAIN SESSION. Says "reading"
// once the first frame has come.
#include <cstdio>
#include <cstdlib>

#include "service/transport/wait_set.h"

int main(int argc, char** argv) {
  using namespace bleedsim::transport;
  if (argc != 3) return 2;
  ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
  const auto participant = Participant::create(options);
  if (!participant) return 1;
  auto frames = Reader<bleed_v1_Frame>::create(*participant, argv[2], readerQos(Topic::frame, Reading::recorder));
  auto journal = Reader<bleed_v1_Journal>::create(*participant, argv[2]);
  auto wait_set = WaitSet::create(*participant);
  if (!frames || !journal || !wait_set || !wait_set->attach(*frames, 0) || !wait_set->attach(*journal, 1)) return 1;
  bool told = false;
  while (wait_set->wait(std::chrono::nanoseconds{-1})) {
    const auto taken = frames->take([](const Sample<bleed_v1_Frame>&) {});
    if (!taken || !journal->take([](const Sample<bleed_v1_Journal>&) {})) return 1;
    if (*taken > 0 && !told) {
      std::puts("reading");
      std::fflush(stdout);
      told = true;
    }
  }
  return 1;
}
