// Writes recordings of every kind into a folder, each NAME.mcap with a NAME.json of what bleedsim's own reader gives back.
//   make_files FOLDER
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <google/protobuf/util/json_util.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "service/recording/convert.h"
#include "service/recording/export.h"
#include "service/recording/frame_layout.h"
#include "service/recording/mcap_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/summary.h"
#include "tests/support/frame_block.h"
#include "tests/unit/recording/random_samples.h"

namespace {

using namespace bleedsim::recording;
using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uint64_t kFrames = 30;
constexpr std::uint32_t kParticles = 300;

void require(const bleedsim::Status& status) {
  if (!status.ok()) throw std::runtime_error{status.message()};
}
template <class T>
T require(bleedsim::Result<T> result) {
  require(result.status());
  return std::move(*result);
}

/// A turning spiral, with numbers of all sizes.
Frame makeFrame(std::uint64_t seq) {
  Frame frame;
  frame.set_session("0123456789abcdef");
  frame.set_seq(seq);
  frame.set_step(seq << 40U);
  frame.set_sim_time_s(static_cast<double>(seq) / 60.0);
  frame.set_monotonic_stamp_ns(-7);
  frame.set_realtime_stamp_ns(1'700'000'000'000'000'001 + static_cast<std::int64_t>(seq));
  frame.set_epoch(1);
  frame.set_count(kParticles);
  std::vector<float> positions;
  std::vector<float> velocities;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < kParticles; ++i) {
    const float angle = 0.1F * static_cast<float>(i) + 0.05F * static_cast<float>(seq);
    const float radius = 1e-4F * static_cast<float>(i);
    for (const float x : {radius * std::cos(angle), radius * std::sin(angle), -1e-9F * static_cast<float>(i)})
      positions.push_back(x);
    for (const float v : {-std::sin(angle), std::cos(angle), 0.0F}) velocities.push_back(v);
    ids.push_back(4'294'967'295U - i);
  }
  test::addBlock(frame, Attribute::POSITION, Attribute::FLOAT32, 3, positions);
  test::addBlock(frame, Attribute::ID, Attribute::UINT32, 1, ids);
  test::addBlock(frame, Attribute::VELOCITY, Attribute::FLOAT32, 3, velocities);
  return frame;
}

void writeFile(const fs::path& path, const WriterOptions& options) {
  std::mt19937_64 random{2};
  RecordingWriter writer = require(RecordingWriter::open(path, options));
  std::uint64_t time = 1'700'000'000'000'000'000;
  const auto put = [&](const auto& message) {
    const auto sample = require(fromRecording(message));
    require(writer.append(*sample, time += 1'000'003));
  };
  Scene scene = test::makeScene(random);
  scene.set_frame_id("theatre");
  put(scene);
  for (std::uint64_t seq = 1; seq <= kFrames; ++seq) {
    put(makeFrame(seq));
    FrameStats stats;
    test::randomize(random, stats);
    put(stats);
    put(test::makeJournal(random, seq, static_cast<int>(seq % test::kJournalKinds)));
    if (seq % 7 != 0) continue;
    bleedsim::recording::Status status;
    test::randomize(random, status);
    put(status);
  }
  require(writer.close());
}

/// As protobuf's own JSON: it knows nothing of MCAP.
template <class Message>
Json toJson(const RecordedMessage& recorded) {
  Message message;
  require(decode(recorded, message));
  std::string text;
  google::protobuf::util::JsonPrintOptions options;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  if (!google::protobuf::util::MessageToJsonString(message, &text, options).ok()) throw std::runtime_error{"no JSON"};
  return Json::parse(text);
}

Json toJson(const RecordedMessage& recorded) {
  switch (recorded.topic) {
    case Topic::frame:
      return toJson<Frame>(recorded);
    case Topic::frame_stats:
      return toJson<FrameStats>(recorded);
    case Topic::status:
      return toJson<bleedsim::recording::Status>(recorded);
    case Topic::journal:
      return toJson<Journal>(recorded);
    case Topic::scene:
      break;
  }
  return toJson<Scene>(recorded);
}

std::string base64(std::span<const char> bytes) {
  Frame carrier;
  carrier.set_payload(bytes.data(), bytes.size());
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(carrier, &text).ok()) throw std::runtime_error{"no JSON"};
  return Json::parse(text)["payload"].get<std::string>();
}

Json framesOf(RecordingReader& reader) {
  Json out = Json::array();
  for (std::size_t i = 0; i < require(reader.frameCount()); ++i) {
    Frame frame;
    require(reader.frame(i, frame));
    const auto blocks = require(layoutOf(frame));
    std::vector<float> positions;
    readFloats(*findBlock(blocks, Attribute::POSITION), positions);
    out.push_back({{"positions", base64({reinterpret_cast<const char*>(positions.data()), positions.size() * 4})},
                   {"ids", base64(findBlock(blocks, Attribute::ID)->bytes)}});
  }
  return out;
}

/// `frames`: those that the clouds of the file were made of.
void describe(const fs::path& path, const Json& frames, std::uint64_t points) {
  RecordingReader reader = require(RecordingReader::open(path));
  const RecordingSummary summary = require(summarize(reader));
  Json out{{"messages", Json::array()}, {"index", Json::object()}, {"frames", frames}, {"points", points}};
  out["compression"] = summary.compression == "none" ? "" : summary.compression;
  const auto error = summary.max_errors.find("position");
  out["max_position_error"] = error == summary.max_errors.end() ? 0.0 : error->second;
  RecordedMessage message;
  while (require(reader.next(message))) {
    const char* topic = infoOf(message.topic).channel;
    out["messages"].push_back(
        {{"topic", topic}, {"log_time_ns", std::to_string(message.log_time_ns)}, {"message", toJson(message)}});
    out["index"][topic] = out["index"].value(topic, 0) + 1;
  }
  std::ofstream{fs::path{path}.replace_extension(".json")} << out.dump();
}

void make(const fs::path& folder) {
  fs::create_directories(folder);
  for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
    for (const bool quantize : {false, true}) {
      for (const bool cloud : {false, true}) {
        WriterOptions options;
        options.compression = compression;
        options.quantize16 = quantize;
        options.point_cloud = cloud;
        options.chunk_bytes = 30'000;
        const fs::path path =
            folder / fmt::format("{}{}{}.mcap", nameOf(compression), quantize ? "_16" : "", cloud ? "_points" : "");
        writeFile(path, options);
        RecordingReader reader = require(RecordingReader::open(path));
        describe(path, framesOf(reader), cloud ? kFrames : 0);
      }
    }
  }
  const fs::path exported = folder / "exported.mcap";
  RecordingReader source = require(RecordingReader::open(folder / "zstd.mcap"));
  require(exportRecording(folder / "zstd.mcap", ExportFormat::mcap_point_cloud, exported));
  describe(exported, framesOf(source), kFrames);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "make_files FOLDER\n");
    return EXIT_FAILURE;
  }
  try {
    make(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
