// What a recording costs: bytes for each particle of each frame, and time for each frame, of every way to store it. The frames
// are those of a recording, so that they compress as real ones do; only frames are written, into /tmp.
//
//   bench_recording FILE.mcap [--benchmark_counters_tabular=true]
//
// write_us is CPU time of the thread that fills the file, compression included; the disk has a thread of its own. read_us is CPU
// time of reading the frames back by number.
#include <benchmark/benchmark.h>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

#include "service/recording/convert.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"

namespace bleedsim::bench {
namespace {

using Samples = std::vector<recording::SamplePtr<bleed_v1_Frame>>;

/// CPU time of this thread, s: other processes do not disturb it much.
double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Status load(const std::string& path, Samples& out) {
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return reader.status();
  const Result<std::size_t> count = reader->frameCount();
  if (!count) return count.status();
  if (*count == 0) return {StatusCode::not_found, "the recording holds no frames"};
  recording::Frame frame;
  for (std::size_t i = 0; i < *count; ++i) {
    if (Status status = reader->frame(i, frame); !status) return status;
    Result<recording::SamplePtr<bleed_v1_Frame>> sample = recording::fromRecording(frame);
    if (!sample) return sample.status();
    out.push_back(std::move(*sample));
  }
  return {};
}

/// Seconds that the frames took; the file lies at `path` afterwards.
Result<double> writeAll(const Samples& samples, const std::filesystem::path& path, const recording::WriterOptions& options) {
  Result<recording::RecordingWriter> writer = recording::RecordingWriter::open(path, options);
  if (!writer) return writer.status();
  const double start = cpuSeconds();
  for (const auto& sample : samples) {
    if (Status status = writer->append(*sample); !status) return status;
  }
  const double time = cpuSeconds() - start;
  if (Status status = writer->close(); !status) return status;
  return time;
}

/// Microseconds for each frame.
Result<double> readAll(const std::filesystem::path& path) {
  const double start = cpuSeconds();
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(path);
  if (!reader) return reader.status();
  const Result<std::size_t> count = reader->frameCount();
  if (!count) return count.status();
  recording::Frame frame;
  for (std::size_t i = 0; i < *count; ++i) {
    if (Status status = reader->frame(i, frame); !status) return status;
  }
  return 1e6 * (cpuSeconds() - start) / static_cast<double>(*count);
}

void record(benchmark::State& state, const Samples& samples, const recording::WriterOptions& options) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("bench_recording_" + std::to_string(::getpid()));
  double particles = 0.0;
  for (const auto& sample : samples) particles += sample->count;
  double seconds = 0.0;
  for (auto _ : state) {
    const Result<double> time = writeAll(samples, path, options);
    if (!time) {
      state.SkipWithError(time.status().message().c_str());
      break;
    }
    state.SetIterationTime(*time);
    seconds += *time;
  }
  std::error_code error;
  const auto frames = static_cast<double>(samples.size());
  state.counters["bytes_per_particle"] = static_cast<double>(std::filesystem::file_size(path, error)) / particles;
  state.counters["write_us"] = 1e6 * seconds / (frames * static_cast<double>(state.iterations()));
  if (const Result<double> time = readAll(path)) state.counters["read_us"] = *time;
  state.counters["particles"] = particles / frames;
  std::filesystem::remove(path, error);
}

}  // namespace
}  // namespace bleedsim::bench

int main(int argc, char** argv) {
  using namespace bleedsim;
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "bench_recording FILE.mcap [--benchmark_...]\n");
    return 2;
  }
  bench::Samples samples;
  if (const Status status = bench::load(argv[1], samples); !status) {
    std::fprintf(stderr, "bench_recording: %s\n", status.message().c_str());
    return 1;
  }
  for (const recording::Compression compression :
       {recording::Compression::none, recording::Compression::lz4, recording::Compression::zstd}) {
    for (const bool quantize : {false, true}) {
      recording::WriterOptions options;
      options.compression = compression;
      options.quantize16 = quantize;
      const std::string name = std::string{recording::nameOf(compression)} + (quantize ? "/16-bit" : "/float");
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&samples, options](benchmark::State& state) { bench::record(state, samples, options); })
          ->UseManualTime()
          ->MinTime(0.3)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
