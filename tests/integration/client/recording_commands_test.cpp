// record, info, export and render as processes, against a real bleedd and against damaged files.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <unistd.h>

#include "service/recording/recording_reader.h"
#include "tests/integration/client/json_value.h"
#include "tests/integration/client/running_daemon.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::client_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t kDomain = 70;
constexpr std::uint64_t kFrameBytes = 3 * sizeof(float) + sizeof(std::uint32_t) + 3 * sizeof(float);

std::string bytesOf(const fs::path& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream file{path, std::ios::binary};
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::vector<std::string> command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {BLEEDCTL_PATH, "--domain", std::to_string(kDomain), "--timeout", "60"});
  return arguments;
}

class RecordingCommandsTest : public testing::Test {
 protected:
  void SetUp() override {
    isolate();
    daemon_ = RunningDaemon::start(BLEEDD_PATH, SCENE_DIR "/round_wound.textproto", "theatre", kDomain);
    ASSERT_NE(daemon_, nullptr);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static test::Finished bleedctl(std::vector<std::string> arguments, bool with_stderr = true) {
    return test::runProcess(command(std::move(arguments)), with_stderr);
  }
  static Json info(const std::string& file) {
    const test::Finished finished = bleedctl({"info", file, "--json"}, false);
    EXPECT_EQ(finished.code, 0) << finished.output;
    return parseJson(finished.output);
  }

  const test::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  std::unique_ptr<RunningDaemon> daemon_;
};

/// Every frame that a reliable subscriber of this process gets.
class FrameCollector {
 public:
  bool start(const std::string& name) {
    auto client = client::Client::create({.domain = kDomain});
    if (!client) return false;
    const auto keep = [this](const client::FramePointer& frame) {
      const std::lock_guard lock{mutex_};
      frames_[frame->header().seq] = frame;
    };
    auto session =
        client->open(name, {.delivery = client::Delivery::queue, .queue_length = 256, .on_frame = keep}, test::kPatience);
    if (!session) return false;
    session_.emplace(std::move(*session));
    return true;
  }
  std::map<std::uint64_t, client::FramePointer> finish() {
    session_.reset();
    return std::move(frames_);
  }

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, client::FramePointer> frames_;
  std::optional<client::Session> session_;  // last: its thread ends before the rest
};

/// The blocks of a frame of this scene: positions, ids, velocities.
std::string payloadOf(const client::Frame& frame) {
  std::string payload;
  const auto append = [&](const void* data, std::size_t size) { payload.append(static_cast<const char*>(data), size); };
  append(frame.positions().data(), frame.positions().size_bytes());
  append(frame.ids().data(), frame.ids().size_bytes());
  append(frame.velocities().data(), frame.velocities().size_bytes());
  return payload;
}

TEST_F(RecordingCommandsTest, WhatWasRecordedIsDescribedExportedAndReadBackEqual) {
  FrameCollector collector;
  ASSERT_TRUE(collector.start("theatre"));
  const std::string file = path("a.mcap");
  const test::Finished recorded = bleedctl({"record", "-o", file, "--duration", "1.5", "--json"}, false);
  ASSERT_EQ(recorded.code, 0) << recorded.output;
  const auto seen = collector.finish();

  const Json figures = info(file);
  const double frames = number(figures, "frames");
  EXPECT_EQ(frames, number(parseJson(recorded.output), "frames"));
  EXPECT_GE(frames + number(figures, "gaps"), 45.0);
  EXPECT_NEAR(number(figures, "duration_s"), 1.5, 2.0 / 60.0);
  EXPECT_GT(number(figures, "last_particles"), number(figures, "first_particles"));
  EXPECT_NEAR(number(figures, "ml_emitted"), 1.5 * number(figures, "duration_s"), 0.06);
  EXPECT_TRUE(member(figures, "replayable").bool_value()) << text(figures, "reason");
  EXPECT_FALSE(member(figures, "truncated").bool_value());
  EXPECT_EQ(text(figures, "session"), "theatre");
  EXPECT_EQ(text(figures, "scene"), "round_wound");
  EXPECT_EQ(text(figures, "build_id") + "\n", test::runProcess({BLEEDD_PATH, "--version"}).output);

  auto reader = recording::RecordingReader::open(file);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  EXPECT_TRUE(reader->verify().ok());
  ASSERT_EQ(static_cast<double>(*reader->frameCount()), frames);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < *reader->frameCount(); ++i) {
    recording::Frame frame;
    ASSERT_TRUE(reader->frame(i, frame).ok());
    EXPECT_EQ(frame.payload().size(), frame.count() * kFrameBytes);
    const auto same = seen.find(frame.seq());
    if (same == seen.end()) continue;
    ++compared;
    EXPECT_EQ(frame.step(), same->second->header().step);
    EXPECT_EQ(frame.sim_time_s(), same->second->header().sim_time_s);
    ASSERT_EQ(frame.count(), same->second->count());
    ASSERT_EQ(frame.payload(), payloadOf(*same->second)) << "frame " << frame.seq();
  }
  EXPECT_GT(compared, 20U);

  const Json exported = parseJson(bleedctl({"export", file, "-o", path("vtk"), "--json"}, false).output);
  EXPECT_EQ(number(exported, "frames"), frames);
  const std::string collection = bytesOf(text(exported, "output"));
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator{path("vtk")}) {
    if (entry.path().extension() != ".vtp") continue;
    ++files;
    EXPECT_THAT(collection, HasSubstr(entry.path().filename().string()));
  }
  EXPECT_EQ(static_cast<double>(files), frames);
  const std::string last = bytesOf(path(fmt::format("vtk/frame_{:06}.vtp", files - 1)));
  EXPECT_THAT(last, HasSubstr(fmt::format(R"(NumberOfPoints="{}")", number(figures, "last_particles"))));
}

TEST_F(RecordingCommandsTest, SixteenBitsAndPointsAreRecordedAndSaid) {
  const std::string file = path("small.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "20", "--compress", "lz4", "--quantize", "16", "--pointcloud"}).code, 0);
  const Json figures = info(file);
  EXPECT_EQ(number(figures, "frames"), 20.0);
  EXPECT_EQ(text(figures, "compression"), "lz4");
  EXPECT_FALSE(member(figures, "bit_exact").bool_value());
  const Json& errors = member(figures, "max_errors");
  EXPECT_GT(number(errors, "position"), 0.0);
  EXPECT_LT(number(errors, "position"), 1e-5);  // m; the scene is 0.2 m wide: half a step is 1.5e-6 m
  EXPECT_THAT(bleedctl({"info", file}).output, HasSubstr("16 bits, not bit-exact: position within"));
  EXPECT_TRUE(member(figures, "replayable").bool_value()) << text(figures, "reason");
  const std::string bytes = bytesOf(file);
  EXPECT_THAT(bytes, HasSubstr("foxglove.PointCloud"));
  EXPECT_THAT(bytes, HasSubstr("/bleed/v1/points"));

  const std::string exact = path("exact.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", exact, "--frames", "5", "--compress", "none"}).code, 0);
  EXPECT_EQ(text(info(exact), "compression"), "none");
  EXPECT_TRUE(member(info(exact), "bit_exact").bool_value());
  EXPECT_THAT(bleedctl({"info", exact}).output, Not(HasSubstr("bit-exact")));

  EXPECT_EQ(bleedctl({"record", "-o", file, "--compress", "gzip"}).code, 2);
  EXPECT_EQ(bleedctl({"record", "-o", file, "--quantize", "8"}).code, 2);
}

TEST_F(RecordingCommandsTest, FramesAreExportedInEachFormat) {
  const std::string file = path("e.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "12"}).code, 0);
  ASSERT_EQ(bleedctl({"export", file, "--format", "ply", "-o", path("ply"), "--every", "5"}).code, 0);
  EXPECT_TRUE(fs::exists(path("ply/frame_000010.ply")));
  EXPECT_EQ(std::distance(fs::directory_iterator{path("ply")}, {}), 3);
  ASSERT_EQ(bleedctl({"export", file, "--format", "csv", "-o", path("e.csv"), "--frame", "11"}).code, 0);
  const std::string table = bytesOf(path("e.csv"));
  EXPECT_TRUE(table.starts_with("frame,epoch,time_s,id,x,y,z,vx,vy,vz")) << table.substr(0, 80);
  EXPECT_EQ(static_cast<double>(std::count(table.begin(), table.end(), '\n')), 1.0 + number(info(file), "last_particles"));
  ASSERT_EQ(bleedctl({"export", file, "--format", "mcap-pointcloud", "-o", path("p.mcap")}).code, 0);
  EXPECT_THAT(bytesOf(path("p.mcap")), HasSubstr("foxglove.PointCloud"));
  EXPECT_EQ(number(info(path("p.mcap")), "frames"), 0.0);

  struct Wrong {
    std::vector<std::string> arguments;
    int code;
    const char* says;
  };
  write(path("taken"), "a file");
  for (const Wrong& wrong :
       std::vector<Wrong>{{{"--format", "abc", "-o", path("x")}, 2, "vtp, ply, csv, mcap-pointcloud"},
                          {{"--frame", "12", "-o", path("x")}, 2, "there is no frame 12: the recording has 12, numbered 0 to 11"},
                          {{"--frame", "-1", "-o", path("x")}, 2, "--frame"},
                          {{"--every", "0", "-o", path("x")}, 2, "--every"},
                          {{"--every", "2", "--frame", "1", "-o", path("x")}, 2, "--every"},
                          {{"--format", "csv", "-o", file}, 2, "is the recording itself"},
                          {{"--format", "csv", "-o", folder_.string()}, 2, "is no regular file"},
                          {{"--format", "ply", "-o", path("taken")}, 4, "cannot create directory"},
                          {{"--format", "mcap-pointcloud", "-o", path("no/such/p.mcap")}, 4, "no/such/p.mcap"}}) {
    std::vector<std::string> arguments{"export", file};
    arguments.insert(arguments.end(), wrong.arguments.begin(), wrong.arguments.end());
    const test::Finished finished = bleedctl(arguments);
    EXPECT_EQ(finished.code, wrong.code) << finished.output;
    EXPECT_THAT(finished.output, HasSubstr(wrong.says));
  }
  EXPECT_EQ(bytesOf(path("taken")), "a file");
}

TEST_F(RecordingCommandsTest, FramesAreDrawn) {
  const std::string file = path("r.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "12"}).code, 0);
  const auto render = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", file, "--size", "160x120"});
    return bleedctl(arguments);
  };
  const std::string png{"\x89PNG\r\n\x1a\n", 8};
  ASSERT_EQ(render({"-o", path("last.png")}).code, 0);
  ASSERT_EQ(render({"-o", path("eleven.png"), "--frame", "11"}).code, 0);
  ASSERT_EQ(render({"-o", path("front.png"), "--view", "front", "--color-by", "speed", "--look", "spheres"}).code, 0);
  EXPECT_TRUE(bytesOf(path("last.png")).starts_with(png));
  EXPECT_EQ(bytesOf(path("last.png")), bytesOf(path("eleven.png"))) << "the last frame is the default";
  EXPECT_NE(bytesOf(path("last.png")), bytesOf(path("front.png")));
  ASSERT_EQ(render({"-o", path("pictures"), "--every", "6"}).code, 0);
  EXPECT_TRUE(fs::exists(path("pictures/frame_000000.png")));
  EXPECT_TRUE(fs::exists(path("pictures/frame_000006.png")));

  struct Wrong {
    std::vector<std::string> arguments;
    int code;
    const char* says;
  };
  for (const Wrong& wrong : std::vector<Wrong>{
           {{"-o", path("x.png"), "--every", "2"}, 2, "give a folder"},
           {{"-o", path("x.png"), "--frame", "12"}, 2, "numbered 0 to 11"},
           {{"-o", path("x.png"), "--view", "below"}, 2, "front, side, top, oblique"},
           {{"-o", path("x.png"), "--color-by", "platelet"}, 2, "cannot be coloured by 'platelet': there is speed"},
           {{"-o", path("x.png"), "--look", "oil"}, 2, "--look"},
           {{"-o", path("no/such/x.png")}, 4, "no/such/x.png"}}) {
    const test::Finished finished = render(wrong.arguments);
    EXPECT_EQ(finished.code, wrong.code) << finished.output;
    EXPECT_THAT(finished.output, HasSubstr(wrong.says));
  }
  for (const char* size : {"0x10", "big", "160", "160x", "160x120x3", "20000x20000"}) {
    EXPECT_EQ(bleedctl({"render", file, "-o", path("x.png"), "--size", size}).code, 2) << size;
  }
  EXPECT_FALSE(fs::exists(path("x.png")));
}

TEST_F(RecordingCommandsTest, AnInterruptClosesTheFileProperly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string file = path("interrupted.mcap");
    test::ChildProcess record{command({"record", "-o", file}), true};
    const auto started = record.readLine();
    ASSERT_TRUE(started.has_value());
    EXPECT_THAT(*started, HasSubstr("recording session 'theatre'"));
    record.signal(signal);
    EXPECT_EQ(record.wait(), 0) << record.output();
    const Json figures = info(file);
    EXPECT_GT(number(figures, "frames"), 0.0);
    EXPECT_FALSE(member(figures, "truncated").bool_value());
  }
}

TEST_F(RecordingCommandsTest, FramesAndRateLimitWhatIsRecorded) {
  const std::string file = path("limited.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "12"}).code, 0);
  EXPECT_EQ(number(info(file), "frames"), 12.0);
  EXPECT_EQ(number(info(file), "skipped"), 0.0);

  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "10", "--rate", "20"}).code, 0);
  const Json slow = info(file);
  EXPECT_EQ(number(slow, "frames"), 10.0);
  EXPECT_GE(number(slow, "skipped"), 1.0);
  EXPECT_GE(number(slow, "duration_s"), 9.0 / 20.0 - 1.0 / 60.0);
  EXPECT_EQ(bleedctl({"record", "-o", file, "--frames", "10", "--duration", "1"}).code, 2);
  EXPECT_EQ(bleedctl({"record", "-o", file, "--frames", "0"}).code, 2);
  EXPECT_EQ(bleedctl({"record", "-o", file, "--rate", "-1"}).code, 2);
}

TEST_F(RecordingCommandsTest, ASessionThatEndsLeavesACompleteFileAndCodeThree) {
  const std::string file = path("ended.mcap");
  test::ChildProcess record{command({"record", "-o", file, "--duration", "1000"}), true};
  ASSERT_TRUE(record.readLine().has_value());
  const test::Finished shutdown = bleedctl({"shutdown"});
  ASSERT_EQ(shutdown.code, 0) << shutdown.output;
  EXPECT_EQ(record.wait(), 3);
  EXPECT_THAT(record.output(), HasSubstr("session 'theatre' ended: the recording is incomplete"));
  EXPECT_GT(number(info(file), "frames"), 0.0);
  EXPECT_FALSE(member(info(file), "truncated").bool_value());
}

TEST_F(RecordingCommandsTest, ASuccessorOfAKilledDaemonIsNotRecorded) {
  const std::string file = path("killed.mcap");
  const client::Uuid first = daemon_->session().status()->session;
  test::ChildProcess record{command({"record", "-o", file, "--duration", "1000"}), true};
  ASSERT_TRUE(record.readLine().has_value());
  daemon_->process().signal(SIGKILL);
  ASSERT_EQ(daemon_->process().wait(), 128 + SIGKILL);
  // The successor runs long before the middleware misses the killed one.
  const auto successor = RunningDaemon::start(BLEEDD_PATH, SCENE_DIR "/round_wound.textproto", "theatre", kDomain);
  ASSERT_NE(successor, nullptr);
  EXPECT_EQ(record.wait(), 3) << record.output();
  EXPECT_THAT(record.output(), HasSubstr("session 'theatre' is gone, another daemon has taken its name"));
  EXPECT_EQ(successor->session().status()->state, client::SessionState::running);

  auto reader = recording::RecordingReader::open(file);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  EXPECT_TRUE(reader->verify().ok());
  const std::string own{first.begin(), first.end()};
  recording::RecordedMessage message;
  std::size_t frames = 0;
  std::size_t scenes = 0;
  for (auto more = reader->next(message); more.ok() && *more; more = reader->next(message)) {
    if (message.topic == recording::Topic::scene) ++scenes;
    if (message.topic != recording::Topic::frame) continue;
    ++frames;
    recording::Frame frame;
    ASSERT_TRUE(recording::decode(message, frame).ok());
    ASSERT_EQ(frame.session(), own) << "frame " << frame.seq();
  }
  EXPECT_GT(frames, 0U);
  EXPECT_EQ(scenes, 1U);
  EXPECT_TRUE(member(info(file), "replayable").bool_value()) << text(info(file), "reason");
}

TEST_F(RecordingCommandsTest, APauseAndItsEndAreAnnounced) {
  const std::string file = path("paused.mcap");
  test::ChildProcess record{command({"record", "-o", file, "--duration", "3"}), true};
  ASSERT_TRUE(record.readLine().has_value());
  ASSERT_EQ(bleedctl({"pause"}).code, 0);
  const auto paused = record.readLine();
  ASSERT_TRUE(paused.has_value());
  EXPECT_THAT(*paused, HasSubstr("is paused: nothing is recorded until it resumes"));
  ASSERT_EQ(bleedctl({"resume"}).code, 0);
  const auto resumed = record.readLine();
  ASSERT_TRUE(resumed.has_value());
  EXPECT_THAT(*resumed, HasSubstr("runs again"));
  EXPECT_EQ(record.wait(), 0) << record.output();
  EXPECT_GE(number(info(file), "duration_s"), 3.0 - 1e-6);
}

TEST_F(RecordingCommandsTest, DamagedFilesAreNamedAndReadAsFarAsTheyGo) {
  const std::string file = path("whole.mcap");
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "20"}).code, 0);
  const std::string whole = bytesOf(file);

  write(path("cut.mcap"), whole.substr(0, whole.size() - 100));
  const Json cut = info(path("cut.mcap"));
  EXPECT_TRUE(member(cut, "truncated").bool_value());
  EXPECT_EQ(number(cut, "frames"), 20.0);
  EXPECT_THAT(bleedctl({"info", path("cut.mcap")}).output, HasSubstr("truncated"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"export", path("cut.mcap"), "-o", path("cut")},
        std::vector<std::string>{"render", path("cut.mcap"), "-o", path("cut.png"), "--size", "160x120"}}) {
    const test::Finished finished = bleedctl(arguments);
    EXPECT_EQ(finished.code, 0) << finished.output;
    EXPECT_THAT(finished.output, HasSubstr("was cut off"));
    EXPECT_THAT(finished.output, HasSubstr("bleedctl recover"));
  }

  write(path("other.mcap"), "not a recording at all, but long enough to be looked at");
  write(path("empty.mcap"), "");
  for (const char* name : {"other.mcap", "empty.mcap", "missing.mcap"}) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", path(name)}, std::vector<std::string>{"export", path(name), "-o", path("vtk")},
          std::vector<std::string>{"export", path(name), "-o", path("x.csv"), "--format", "csv"},
          std::vector<std::string>{"render", path(name), "-o", path("x.png")}}) {
      const test::Finished finished = bleedctl(arguments);
      EXPECT_EQ(finished.code, 4) << arguments.front() << " " << name << ": " << finished.output;
      EXPECT_THAT(finished.output, HasSubstr(name));
    }
  }
  std::string flipped = whole;
  flipped[flipped.size() / 3] = static_cast<char>(flipped[flipped.size() / 3] ^ 0x5a);
  write(path("flipped.mcap"), flipped);
  const test::Finished damaged = bleedctl({"info", path("flipped.mcap")});
  EXPECT_EQ(damaged.code, 4) << damaged.output;
  EXPECT_THAT(damaged.output, HasSubstr("flipped.mcap"));
  EXPECT_EQ(bleedctl({"record", "-o", path("no/such/folder.mcap")}).code, 4);
}

}  // namespace
}  // namespace bleedsim::client_test
