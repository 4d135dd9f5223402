// Encoding a frame, and publishing it to one reliable reader of the same process until it arrives, at 12k, 20k and 100k
// particles. Between processes the kernel's loopback comes on top.
#include <benchmark/benchmark.h>

#include "service/dds/frame_encoder.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"
#include "service/transport/writer.h"

namespace {

using namespace bleedsim;

constexpr std::uint32_t kDomain = 58;

dds::FrameSnapshot snapshotOf(std::uint32_t particles) {
  dds::FrameSnapshot snapshot;
  snapshot.reserve(particles);
  snapshot.frame.position.assign(std::size_t{particles} * 3, 0.25F);
  snapshot.frame.id.assign(particles, 7);
  snapshot.frame.count = particles;
  return snapshot;
}

void encode(benchmark::State& state) {
  const auto particles = static_cast<std::uint32_t>(state.range(0));
  const dds::FrameSnapshot snapshot = snapshotOf(particles);
  dds::FrameEncoder encoder{transport::drawUuid()};
  encoder.reserve(particles);
  std::uint64_t seq = 0;
  for (auto _ : state) benchmark::DoNotOptimize(encoder.encode(snapshot, ++seq));
  state.SetBytesProcessed(state.iterations() * particles * 16);
}

void encodeAndPublish(benchmark::State& state) {
  const auto particles = static_cast<std::uint32_t>(state.range(0));
  transport::ParticipantOptions options;
  options.domain = kDomain;
  const auto participant = transport::Participant::create(options);
  if (!participant) {
    state.SkipWithError(participant.status().message().c_str());
    return;
  }
  auto reader = transport::Reader<bleed_v1_Frame>::create(
      *participant, "bench", transport::readerQos(transport::Topic::frame, transport::Reading::reliable));
  auto writer = transport::Writer<bleed_v1_Frame>::create(*participant, "bench");
  auto wait_set = transport::WaitSet::create(*participant);
  if (!reader || !writer || !wait_set || !wait_set->attach(*reader, 0)) {
    state.SkipWithError("could not create the endpoints");
    return;
  }
  const dds::FrameSnapshot snapshot = snapshotOf(particles);
  dds::FrameEncoder encoder{transport::drawUuid()};
  encoder.reserve(particles);
  std::uint64_t seq = 0;
  for (auto _ : state) {
    if (!writer->write(encoder.encode(snapshot, ++seq))) state.SkipWithError("write failed");
    bool arrived = false;
    while (!arrived && wait_set->wait(std::chrono::seconds{10})) {
      const auto look = [&](const transport::Sample<bleed_v1_Frame>& sample) {
        arrived = arrived || (sample.data != nullptr && sample.data->seq == seq);
      };
      if (!reader->take(look)) break;
    }
  }
  state.SetBytesProcessed(state.iterations() * particles * 16);
}

BENCHMARK(encode)->Arg(12'000)->Arg(20'000)->Arg(100'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(encodeAndPublish)->Arg(12'000)->Arg(20'000)->Arg(100'000)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
