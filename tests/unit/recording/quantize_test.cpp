// Frames of 16-bit numbers: the stated error is above the true one, and ids are exact.
#include "service/recording/quantize.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "service/recording/convert.h"
#include "service/recording/frame_columns.h"
#include "service/recording/frame_layout.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/recover.h"
#include "service/recording/summary.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

struct Block {
  Attribute::Semantic semantic;
  std::uint32_t components;
  std::vector<float> values;
};

Frame frameOf(std::uint64_t seq, std::uint32_t count, const std::vector<Block>& blocks) {
  Frame frame;
  frame.set_session("0123456789abcdef");
  frame.set_seq(seq);
  frame.set_epoch(1);
  frame.set_count(count);
  const auto add = [&](Attribute::Semantic semantic, Attribute::ScalarType type, std::uint32_t components, const void* data) {
    Attribute& attribute = *frame.add_attributes();
    attribute.set_semantic(semantic);
    attribute.set_scalar_type(type);
    attribute.set_components(components);
    frame.mutable_payload()->append(static_cast<const char*>(data), std::size_t{count} * components * 4);
  };
  for (const Block& block : blocks) add(block.semantic, Attribute::FLOAT32, block.components, block.values.data());
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < count; ++i) ids.push_back(4'294'967'295U - 65'537U * i);
  add(Attribute::ID, Attribute::UINT32, 1, ids.data());
  return frame;
}

std::vector<float> spread(std::mt19937_64& random, std::size_t count, float lower, float upper) {
  std::uniform_real_distribution<float> draw{lower, upper};
  std::vector<float> out(count);
  for (float& value : out) value = draw(random);
  return out;
}

std::vector<float> valuesOf(const Frame& frame, Attribute::Semantic semantic) {
  const auto blocks = layoutOf(frame);
  EXPECT_TRUE(blocks.ok());
  std::vector<float> out;
  readFloats(*findBlock(*blocks, semantic), out);
  return out;
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return most;
}

// The bound is half a step of (greatest - least)/65535 plus the rounding of offset + scale * stored in floats. It must hold, and
// for wide ranges be no more than a little above what occurs.
TEST(Quantize, TheTrueErrorIsBelowTheStatedOne) {
  std::mt19937_64 random{17};
  struct Case {
    float lower;
    float upper;
    bool tight;
  };
  for (const Case& c : {Case{-0.1F, 0.1F, true}, Case{0.0F, 3e-9F, true}, Case{-1e6F, 2e6F, true}, Case{999.9F, 1000.1F, false},
                        Case{-1e-30F, 1e-30F, true}, Case{1e-44F, 5e-40F, false}, Case{-1.5e38F, 1.5e38F, true}}) {
    const std::vector<float> values = spread(random, 30'000, c.lower, c.upper);
    Frame frame = frameOf(1, 10'000, {{Attribute::POSITION, 3, values}});
    const std::size_t before = frame.payload().size();
    ASSERT_TRUE(quantize16(frame).ok());
    EXPECT_EQ(frame.payload().size(), before - values.size() * 2);
    const double stated = maxErrorOf(frame.attributes(0));
    const double seen = largestDifference(valuesOf(frame, Attribute::POSITION), values);
    EXPECT_LE(seen, stated) << c.lower << " to " << c.upper;
    const double half_step = 0.5 * (static_cast<double>(c.upper) - static_cast<double>(c.lower)) / 65535.0;
    if (c.tight) {
      EXPECT_GT(seen, 0.95 * half_step);
      EXPECT_LT(stated, 1.05 * half_step);
    }
  }
}

TEST(Quantize, IdsAndConstantsAreExactAndOddNumbersStayFloats) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> positions{0.1F, 0.2F, 0.3F, -0.5F, 0.25F, 7.0F};
  Frame frame = frameOf(1, 2,
                        {{Attribute::POSITION, 3, positions},
                         {Attribute::DENSITY, 1, {1060.3F, 1060.3F}},
                         {Attribute::VISCOSITY, 1, {0.1F, inf}},
                         {Attribute::RADIUS, 1, {-3e38F, 3e38F}}});
  const std::string ids = frame.payload().substr(frame.payload().size() - 8);
  ASSERT_TRUE(quantize16(frame).ok());
  EXPECT_EQ(frame.payload().substr(frame.payload().size() - 8), ids);
  EXPECT_EQ(valuesOf(frame, Attribute::DENSITY), (std::vector<float>{1060.3F, 1060.3F}));
  EXPECT_EQ(maxErrorOf(frame.attributes(1)), 0.0);
  EXPECT_EQ(frame.attributes(2).scalar_type(), Attribute::FLOAT32);
  EXPECT_EQ(valuesOf(frame, Attribute::VISCOSITY), (std::vector<float>{0.1F, inf}));
  EXPECT_EQ(frame.attributes(3).scalar_type(), Attribute::FLOAT32);
  const std::string once = frame.SerializeAsString();
  ASSERT_TRUE(quantize16(frame).ok());
  EXPECT_EQ(frame.attributes(0).scalar_type(), Attribute::UINT16);
  EXPECT_EQ(frame.SerializeAsString(), once);

  Frame empty = frameOf(1, 0, {{Attribute::POSITION, 3, {}}});
  EXPECT_TRUE(quantize16(empty).ok());
  EXPECT_TRUE(layoutOf(empty).ok());
  frame.mutable_payload()->pop_back();
  EXPECT_EQ(quantize16(frame).code(), StatusCode::data_loss);
}

class QuantizedFile : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random{23};
    WriterOptions options;
    options.quantize16 = true;
    options.chunk_bytes = 20'000;
    auto writer = RecordingWriter::open(file_.path(), options);
    ASSERT_TRUE(writer.ok());
    for (std::uint64_t seq = 1; seq <= 12; ++seq) {
      const float reach = 0.01F * static_cast<float>(seq);
      frames_.push_back(frameOf(seq, 1000,
                                {{Attribute::POSITION, 3, spread(random, 3000, -reach, reach)},
                                 {Attribute::VELOCITY, 3, spread(random, 3000, -1.0F, reach)}}));
      auto sample = fromRecording(frames_.back());
      ASSERT_TRUE(sample.ok());
      ASSERT_TRUE(writer->append(**sample).ok());
    }
    bleed_v1_Frame hollow{};
    hollow.count = 3;
    EXPECT_FALSE(writer->append(hollow).ok());
    EXPECT_EQ(writer->counts().refused, 1U);
    ASSERT_TRUE(writer->close().ok());
  }

  /// The errors that a file states are those of its frames, and above the true ones.
  void expectStated(const std::filesystem::path& path, std::size_t frames) {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    const auto summary = summarize(*reader);
    ASSERT_TRUE(summary.ok());
    ASSERT_EQ(summary->max_errors.size(), 2U);
    ASSERT_EQ(*reader->frameCount(), frames);
    std::map<std::string, double> seen;
    for (std::size_t i = 0; i < frames; ++i) {
      Frame back;
      ASSERT_TRUE(reader->frame(i, back).ok());
      FrameColumns columns;
      ASSERT_TRUE(toColumns(back, columns).ok());
      FrameColumns original;
      ASSERT_TRUE(toColumns(frames_[i], original).ok());
      EXPECT_EQ(columns.ids, original.ids);
      for (const auto& [name, semantic] :
           std::map<std::string, Attribute::Semantic>{{"position", Attribute::POSITION}, {"velocity", Attribute::VELOCITY}}) {
        seen[name] = std::max(seen[name], largestDifference(valuesOf(back, semantic), valuesOf(frames_[i], semantic)));
      }
    }
    for (const auto& [name, stated] : summary->max_errors) {
      EXPECT_LE(seen[name], stated) << name;
      EXPECT_GT(seen[name], 0.8 * stated) << name;
    }
  }

  ScratchFile file_{"quantized.mcap"};
  std::vector<Frame> frames_;
};

TEST_F(QuantizedFile, StatesItsErrorAndGivesTheValuesBack) {
  expectStated(file_.path(), 12);
  auto reader = RecordingReader::open(file_.path());
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader->metadata().at("bleedsim.notes").at("quantize_bits"), "16");
  const auto& figures = reader->metadata().at("bleedsim.recording");
  const auto summary = summarize(*reader);
  EXPECT_EQ(std::stod(figures.at("max_error_position")), summary->max_errors.at("position"));
  EXPECT_EQ(std::stod(figures.at("max_error_velocity")), summary->max_errors.at("velocity"));
}

TEST_F(QuantizedFile, StatesItAlsoWhenItWasCutOffAndRecovered) {
  const std::string whole = readAll(file_.path());
  writeAll(file_.path(), whole.substr(0, whole.size() * 2 / 3));
  auto cut = RecordingReader::open(file_.path());
  ASSERT_TRUE(cut.ok());
  const std::size_t frames = *cut->frameCount();
  ASSERT_GT(frames, 2U);
  expectStated(file_.path(), frames);
  const ScratchFile recovered{"quantized_recovered.mcap"};
  ASSERT_TRUE(recover(file_.path(), recovered.path()).ok());
  expectStated(recovered.path(), frames);
  auto reader = RecordingReader::open(recovered.path());
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader->metadata().at("bleedsim.recording").contains("max_error_position"));
}

}  // namespace
}  // namespace bleedsim::recording::test
