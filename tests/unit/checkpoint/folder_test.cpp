// A folder of checkpoints: names, the order of age, what is deleted, and what a kill leaves behind.
#include "service/checkpoint/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/status/checkpoint_name.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/checkpoint/sample_checkpoint.h"

namespace bleedsim::checkpoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class FolderTest : public testing::Test {
 protected:
  void SetUp() override { open(); }

  void open() {
    folder_.reset();
    Result<Folder> folder = Folder::open(scratch_.path() / "theatre");
    ASSERT_TRUE(folder.ok()) << folder.status().message();
    folder_.emplace(std::move(*folder));
  }
  std::string write(const std::string& name) {
    Head head = checkpoint_.head;
    head.name = name;
    const Status written = folder_->write(head, checkpoint_.state);
    return written.ok() ? head.name : "refused: " + written.message();
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const Entry& entry : folder_->list()) out.push_back(entry.name + (entry.readable.ok() ? "" : " (damaged)"));
    return out;
  }
  std::filesystem::path file(const std::string& name) const { return folder_->path() / (name + ".bleedstate"); }

  test::TemporaryFolder scratch_;
  Checkpoint checkpoint_ = sampleCheckpoint(3);
  std::optional<Folder> folder_;
};

TEST_F(FolderTest, NamesAutomaticOnesAndKeepsTheLastThree) {
  EXPECT_EQ(write(""), "auto-00000001");
  EXPECT_EQ(write("before"), "before");
  EXPECT_EQ(write(""), "auto-00000003");
  EXPECT_EQ(write(""), "auto-00000004");
  EXPECT_THAT(names(), ElementsAre("auto-00000004", "auto-00000003", "before", "auto-00000001"));
  EXPECT_EQ(write(""), "auto-00000005");
  EXPECT_THAT(names(), ElementsAre("auto-00000005", "auto-00000004", "auto-00000003", "before"));
  EXPECT_EQ(write("before"), "before");
  EXPECT_THAT(names(), ElementsAre("before", "auto-00000005", "auto-00000004", "auto-00000003"));
}

TEST_F(FolderTest, GoesOnCountingWhereAnotherProcessEnded) {
  write("");
  write("");
  open();
  EXPECT_EQ(write(""), "auto-00000003");
  // A damaged file tells no serial; its name is not given again all the same.
  writeAll(file("auto-00000004"), "bad");
  open();
  EXPECT_EQ(write(""), "auto-00000005");
  EXPECT_EQ(test::contentOf(file("auto-00000004")), "bad");
}

TEST_F(FolderTest, ReadsByNameAndTellsWhich) {
  write("good");
  const Result<Checkpoint> read = folder_->read("good");
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->state, checkpoint_.state);
  EXPECT_EQ(folder_->read("none").status().message(), "there is no checkpoint 'none'");
  std::string bytes = test::contentOf(file("good"));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  writeAll(file("good"), bytes);
  EXPECT_EQ(folder_->read("good").status().message(), "checkpoint 'good': its state is damaged: the checksum is another");
  writeAll(file("cut"), "bleedsim state\n\x01");
  EXPECT_THAT(folder_->read("cut").status().message(), HasSubstr("checkpoint 'cut': it is cut off"));
  EXPECT_THAT(names(), ElementsAre("good", "cut (damaged)"));
  write("other");
  std::filesystem::rename(file("other"), file("renamed"));
  EXPECT_THAT(folder_->read("renamed").status().message(), HasSubstr("it was saved as 'other'"));
}

TEST_F(FolderTest, TakesNoPathForAName) {
  for (const char* name : {"", "../x", "a/b", "a.b", "-a", "_a", "a b", "\xc3\xa4", "a\n"}) {
    EXPECT_EQ(folder_->read(name).status().code(), StatusCode::invalid_argument) << name;
    EXPECT_FALSE(checkCheckpointName(name).ok()) << name;
  }
  EXPECT_FALSE(checkCheckpointName(std::string(49, 'a')).ok());
  EXPECT_TRUE(checkCheckpointName(std::string(48, 'a')).ok());
  EXPECT_THAT(write("../x"), HasSubstr("refused: checkpoint '../x': use 1 to 48 letters"));
}

TEST_F(FolderTest, KeepsABoundedNumberOfNamedOnes) {
  for (std::size_t i = 0; i < Folder::kMaxNamed; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    EXPECT_EQ(write(name), name);
  }
  EXPECT_THAT(write("more"), HasSubstr("there are 16 checkpoints with a name"));
  EXPECT_EQ(write("c"), "c") << "one of them may be replaced";
  EXPECT_EQ(write(""), "auto-00000018") << "automatic ones have room of their own";
}

TEST_F(FolderTest, ClearsWhatAKillLeft) {
  write("good");
  writeAll(file("good").string() + ".part", "half");
  writeAll(folder_->path() / "notes.txt", "not ours");
  open();
  EXPECT_FALSE(std::filesystem::exists(file("good").string() + ".part"));
  EXPECT_TRUE(std::filesystem::exists(folder_->path() / "notes.txt"));
  EXPECT_THAT(names(), ElementsAre("good"));
}

TEST_F(FolderTest, BelongsToOneProcessAtATime) {
  const Result<Folder> second = Folder::open(folder_->path());
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::unavailable);
  EXPECT_THAT(second.status().message(), HasSubstr("another bleedd writes into"));
}

TEST_F(FolderTest, SaysWhenItCannotBeMade) {
  writeAll(scratch_.path() / "file", "x");
  const Result<Folder> folder = Folder::open(scratch_.path() / "file" / "below");
  ASSERT_FALSE(folder.ok());
  EXPECT_THAT(folder.status().message(), HasSubstr("cannot create the checkpoints' folder"));
}

}  // namespace
}  // namespace bleedsim::checkpoint
