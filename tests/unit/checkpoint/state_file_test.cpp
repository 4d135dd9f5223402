// The file of a checkpoint: what is written is read, and damage is told.
#include "service/checkpoint/state_file.h"

#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <zlib.h>

#include "service/checkpoint/rebuild.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/checkpoint/sample_checkpoint.h"

namespace bleedsim::checkpoint {
namespace {

using testing::HasSubstr;

void expectSame(const Head& a, const Head& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.serial, b.serial);
  EXPECT_EQ(a.realtime_stamp_ns, b.realtime_stamp_ns);
  EXPECT_EQ(a.build_id, b.build_id);
  EXPECT_EQ(a.simd_target, b.simd_target);
  EXPECT_EQ(a.precision, b.precision);
  EXPECT_EQ(a.session_name, b.session_name);
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.scene_text, b.scene_text);
  EXPECT_EQ(a.loaded_text, b.loaded_text);
  EXPECT_EQ(a.former_settings, b.former_settings);
  EXPECT_EQ(a.decided_for_wound, b.decided_for_wound);
  EXPECT_EQ(a.mark.epoch, b.mark.epoch);
  EXPECT_EQ(a.mark.step, b.mark.step);
  EXPECT_EQ(a.mark.sim_time, b.mark.sim_time);
  EXPECT_EQ(a.mark.state_hash, b.mark.state_hash);
  EXPECT_EQ(a.mark.journal_number, b.mark.journal_number);
  EXPECT_EQ(a.mark.speed_of_sound, b.mark.speed_of_sound);
  EXPECT_EQ(a.mark.narrowest_wound, b.mark.narrowest_wound);
  EXPECT_EQ(a.mark.frame_rate, b.mark.frame_rate);
  EXPECT_EQ(a.mark.attributes, b.mark.attributes);
  EXPECT_EQ(a.mark.paused, b.mark.paused);
  EXPECT_EQ(a.mark.next_force_key, b.mark.next_force_key);
  EXPECT_EQ(a.mark.next_tool_key, b.mark.next_tool_key);
  ASSERT_EQ(a.mark.tool_count, b.mark.tool_count);
  for (std::size_t i = 0; i < a.mark.tool_count; ++i) EXPECT_EQ(a.mark.tools[i], b.mark.tools[i]);
}

std::string refusal(const std::string& file) {
  const Result<Checkpoint> read = decodeCheckpoint(bytesOf(file));
  EXPECT_FALSE(read.ok());
  return read.status().message();
}

/// With the checksum of the first bytes made right again.
std::string resealed(std::string file) {
  const auto crc = static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(file.data()), 36));
  std::memcpy(file.data() + 36, &crc, sizeof crc);
  return file;
}

TEST(StateFile, IsReadAsItWasWritten) {
  const test::TemporaryFolder folder;
  const Checkpoint checkpoint = sampleCheckpoint();
  const std::filesystem::path path = folder.path() / "sample.bleedstate";
  ASSERT_TRUE(writeCheckpoint(path, checkpoint.head, checkpoint.state).ok());
  const Result<Checkpoint> read = readCheckpoint(path);
  ASSERT_TRUE(read.ok()) << read.status().message();
  expectSame(read->head, checkpoint.head);
  EXPECT_EQ(read->state, checkpoint.state);
  const Result<Head> head = readHead(path);
  ASSERT_TRUE(head.ok());
  expectSame(*head, checkpoint.head);
  EXPECT_EQ(test::contentOf(path), encodeCheckpoint(checkpoint.head, checkpoint.state));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "sample.bleedstate.part"));
}

TEST(StateFile, TellsWhatIsDamaged) {
  const Checkpoint checkpoint = sampleCheckpoint();
  const std::string good = encodeCheckpoint(checkpoint.head, checkpoint.state);
  const auto with = [&good](std::size_t at, char bits) {
    std::string file = good;
    file[at] = static_cast<char>(file[at] ^ bits);
    return file;
  };
  std::uint32_t head_bytes = 0;
  std::memcpy(&head_bytes, good.data() + 16, sizeof head_bytes);
  EXPECT_THAT(refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("bleedsim"), HasSubstr("no checkpoint of bleedsim"));
  EXPECT_THAT(refusal(with(0, 1)), HasSubstr("no checkpoint of bleedsim"));
  EXPECT_THAT(refusal(with(15, 2)), HasSubstr("its format has version 3, this build reads version 1"));
  EXPECT_THAT(refusal(good.substr(0, 30)), HasSubstr("cut off: 30 bytes"));
  EXPECT_THAT(refusal(with(20, 1)), HasSubstr("its first bytes are damaged"));
  EXPECT_THAT(refusal(with(36, 1)), HasSubstr("its first bytes are damaged"));
  EXPECT_THAT(refusal(resealed(with(19, 1))), HasSubstr("its head has"));
  EXPECT_THAT(refusal(good.substr(0, good.size() - 1)), HasSubstr("cut off"));
  EXPECT_THAT(refusal(good.substr(0, 60)), HasSubstr("cut off"));
  EXPECT_THAT(refusal(good + "x"), HasSubstr("1 bytes follow its end"));
  EXPECT_THAT(refusal(with(40, 1)), HasSubstr("its head is damaged"));
  EXPECT_THAT(refusal(with(40 + head_bytes - 1, 1)), HasSubstr("its head is damaged"));
  EXPECT_THAT(refusal(with(40 + head_bytes, 1)), HasSubstr("its state is damaged"));
  EXPECT_THAT(refusal(with(good.size() - 1, 64)), HasSubstr("its state is damaged"));
}

TEST(StateFile, RefusesHeadsThatNoCheckpointHas) {
  const Checkpoint checkpoint = sampleCheckpoint();
  const auto refused = [&](const std::function<void(Head&)>& change) {
    Head head = checkpoint.head;
    change(head);
    return refusal(encodeCheckpoint(head, checkpoint.state));
  };
  EXPECT_THAT(refused([](Head& h) { h.name = std::string{"../etc"}; }), HasSubstr("a wrong name"));
  EXPECT_THAT(refused([](Head& h) { h.scene_text.clear(); }), HasSubstr("a wrong scene_text"));
  EXPECT_THAT(refused([](Head& h) { h.loaded_text.assign(std::size_t{1} << 21, 'a'); }), HasSubstr("a wrong loaded_text"));
  EXPECT_THAT(refused([](Head& h) { h.mark.sim_time = -1.0; }), HasSubstr("a wrong sim_time_s"));
  EXPECT_THAT(refused([](Head& h) { h.mark.frame_rate = 0.0; }), HasSubstr("a wrong frame_rate_hz"));
  EXPECT_THAT(refused([](Head& h) { h.mark.speed_of_sound = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("a wrong speed_of_sound"));
  EXPECT_THAT(refused([](Head& h) { h.mark.narrowest_wound = 0.0; }), HasSubstr("a wrong narrowest_wound_m"));
}

TEST(StateFile, NoBitMayBeWrong) {
  const Checkpoint checkpoint = sampleCheckpoint();
  const std::string good = encodeCheckpoint(checkpoint.head, checkpoint.state);
  std::mt19937 random{20261126};
  for (int k = 0; k < 500; ++k) {
    std::string file = good;
    const std::size_t at = random() % file.size();
    file[at] = static_cast<char>(file[at] ^ (1 << random() % 8));
    EXPECT_FALSE(decodeCheckpoint(bytesOf(file)).ok()) << "byte " << at;
  }
}

TEST(StateFile, SaysWhyItCannotBeReadOrWritten) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(readCheckpoint(folder.path() / "none").status().code(), StatusCode::not_found);
  EXPECT_THAT(readCheckpoint(folder.path()).status().message(), HasSubstr("no regular file"));
  const Checkpoint checkpoint = sampleCheckpoint(1);
  const Status written = writeCheckpoint(folder.path() / "no" / "folder", checkpoint.head, checkpoint.state);
  EXPECT_EQ(written.code(), StatusCode::io);
  EXPECT_THAT(written.message(), HasSubstr("cannot create"));
}

TEST(StateFile, AFailedWriteLeavesTheFormerFile) {
  const test::TemporaryFolder folder;
  const Checkpoint checkpoint = sampleCheckpoint(1);
  const std::filesystem::path path = folder.path() / "sample.bleedstate";
  ASSERT_TRUE(writeCheckpoint(path, checkpoint.head, checkpoint.state).ok());
  const std::string before = test::contentOf(path);
  // Where the unfinished file would be, nothing can be written.
  std::filesystem::create_directory(folder.path() / "sample.bleedstate.part");
  EXPECT_FALSE(writeCheckpoint(path, sampleCheckpoint(5).head, checkpoint.state).ok());
  EXPECT_EQ(test::contentOf(path), before);
}

class Rebuild : public testing::Test {
 protected:
  std::string refusal(const sph::WorldOptions& options = {}, const std::string& build = buildId()) {
    const Result<Rebuilt> rebuilt = rebuild(checkpoint_, options, build);
    EXPECT_FALSE(rebuilt.ok());
    return rebuilt.status().message();
  }

  Checkpoint checkpoint_ = sampleCheckpoint();
};

TEST_F(Rebuild, GivesTheWorldInItsState) {
  const Result<Rebuilt> rebuilt = rebuild(checkpoint_, {.threads = 2}, buildId());
  ASSERT_TRUE(rebuilt.ok()) << rebuilt.status().message();
  EXPECT_EQ(rebuilt->world->stateHash(), checkpoint_.head.mark.state_hash);
  EXPECT_EQ(rebuilt->world->stepCount(), 30u);
  EXPECT_EQ(rebuilt->world->woundName(1), "cut");
  EXPECT_EQ(rebuilt->scene->normalized_text, checkpoint_.head.scene_text);
  EXPECT_EQ(rebuilt->scene->former_settings, checkpoint_.head.former_settings);
  EXPECT_EQ(rebuilt->loaded->normalized_text, checkpoint_.head.loaded_text);
}

TEST_F(Rebuild, RefusesWhatIsNotOfThisBuildOrTarget) {
  EXPECT_THAT(refusal({}, "other build"), HasSubstr("it is of build '" + buildId() + "', this is 'other build'"));
  checkpoint_.head.simd_target = std::string{"scalar"};
  const std::vector<sph::SimdTarget> targets = sph::availableSimdTargets();
  if (targets.front() != sph::SimdTarget::scalar) {
    EXPECT_THAT(refusal({.simd = targets.front()}), HasSubstr("it is of SIMD target 'scalar'"));
  }
  checkpoint_.head.simd_target = std::string{"auto"};
  EXPECT_THAT(refusal(), HasSubstr("its SIMD target is 'auto'"));
}

TEST_F(Rebuild, RefusesWhatDoesNotBelongTogether) {
  Checkpoint good = checkpoint_;
  checkpoint_.head.mark.state_hash ^= 1;
  EXPECT_THAT(refusal(), HasSubstr("not the one that its head tells of"));
  checkpoint_ = good;
  checkpoint_.head.precision = std::string{"float64"};
  EXPECT_FALSE(rebuild(checkpoint_, {}, buildId()).ok());
  checkpoint_.head.precision = std::string{"half"};
  EXPECT_THAT(refusal(), HasSubstr("its precision is 'half'"));
  checkpoint_ = good;
  checkpoint_.head.scene_text = std::string{"nonsense"};
  EXPECT_FALSE(rebuild(checkpoint_, {}, buildId()).ok());
  checkpoint_ = good;
  checkpoint_.head.mark.speed_of_sound *= 2.0;
  EXPECT_THAT(refusal(), HasSubstr("another speed of sound"));
}

}  // namespace
}  // namespace bleedsim::checkpoint
