#include "tests/unit/recording/random_samples.h"

#include <fstream>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

#include "service/recording/convert.h"
#include "service/recording/recording_writer.h"

namespace bleedsim::recording::test {
namespace {

constexpr std::uint64_t kStartNs = 1'700'000'000'000'000'000;
const std::string kSession = "0123456789abcdef";

std::string randomBytes(std::mt19937_64& random, std::size_t count) {
  std::string out(count, '\0');
  for (char& byte : out) byte = static_cast<char>(random() & 0xffU);
  return out;
}

double randomDouble(std::mt19937_64& random) { return std::uniform_real_distribution<double>{-1e6, 1e6}(random); }

}  // namespace

ScratchFile::ScratchFile(const std::string& name)
    : path_{std::filesystem::path{testing::TempDir()} / (std::to_string(::getpid()) + "_" + name)} {
  std::filesystem::remove_all(path_);
}
ScratchFile::~ScratchFile() { std::filesystem::remove_all(path_); }

std::string readAll(const std::filesystem::path& path) {
  std::ifstream in{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

void writeAll(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream out{path, std::ios::binary};
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void randomize(std::mt19937_64& random, google::protobuf::Message& message) {
  using google::protobuf::FieldDescriptor;
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message.GetDescriptor()->field(i);
    if (field->real_containing_oneof() != nullptr) continue;
    const int entries = field->is_repeated() ? static_cast<int>(random() % 6) : 1;
    for (int n = 0; n < entries; ++n) {
      const auto put = [&](auto set, auto add, auto value) {
        if (field->is_repeated()) {
          (reflection.*add)(&message, field, value);
        } else {
          (reflection.*set)(&message, field, value);
        }
      };
      using R = google::protobuf::Reflection;
      switch (field->cpp_type()) {
        case FieldDescriptor::CPPTYPE_DOUBLE:
          put(&R::SetDouble, &R::AddDouble, randomDouble(random));
          break;
        case FieldDescriptor::CPPTYPE_FLOAT:
          put(&R::SetFloat, &R::AddFloat, static_cast<float>(randomDouble(random)));
          break;
        case FieldDescriptor::CPPTYPE_UINT64:
          put(&R::SetUInt64, &R::AddUInt64, std::uint64_t{random()});
          break;
        case FieldDescriptor::CPPTYPE_INT64:
          put(&R::SetInt64, &R::AddInt64, static_cast<std::int64_t>(random()));
          break;
        case FieldDescriptor::CPPTYPE_UINT32:
          put(&R::SetUInt32, &R::AddUInt32, static_cast<std::uint32_t>(random() & 0xffU));
          break;
        case FieldDescriptor::CPPTYPE_INT32:
          put(&R::SetInt32, &R::AddInt32, static_cast<std::int32_t>(random()));
          break;
        case FieldDescriptor::CPPTYPE_BOOL:
          put(&R::SetBool, &R::AddBool, (random() & 1U) != 0);
          break;
        case FieldDescriptor::CPPTYPE_ENUM:
          put(&R::SetEnumValue, &R::AddEnumValue, static_cast<int>(random() % 3));
          break;
        case FieldDescriptor::CPPTYPE_STRING: {
          const bool bytes = field->type() == FieldDescriptor::TYPE_BYTES;
          const std::string value = bytes ? randomBytes(random, 16) : "text " + std::to_string(random() % 100'000) + " \xc3\xa4";
          if (field->is_repeated()) {
            reflection.AddString(&message, field, value);
          } else {
            reflection.SetString(&message, field, value);
          }
          break;
        }
        case FieldDescriptor::CPPTYPE_MESSAGE:
          randomize(random,
                    field->is_repeated() ? *reflection.AddMessage(&message, field) : *reflection.MutableMessage(&message, field));
          break;
      }
    }
  }
}

Frame makeFrame(std::mt19937_64& random, std::uint64_t seq, std::uint32_t count) {
  Frame frame;
  frame.set_session(kSession);
  frame.set_seq(seq);
  frame.set_step(seq * 10);
  frame.set_sim_time_s(static_cast<double>(seq) / 60.0);
  frame.set_realtime_stamp_ns(static_cast<std::int64_t>(kStartNs + seq));
  frame.set_monotonic_stamp_ns(-5);
  frame.set_epoch(1);
  frame.set_count(count);
  const auto add = [&](Attribute::Semantic semantic, Attribute::ScalarType type, std::uint32_t components, std::size_t bytes) {
    Attribute& attribute = *frame.add_attributes();
    attribute.set_semantic(semantic);
    attribute.set_scalar_type(type);
    attribute.set_components(components);
    attribute.set_scale(0.5F);
    attribute.set_offset(-1.0F);
    frame.mutable_payload()->append(randomBytes(random, bytes * components * count));
  };
  add(Attribute::POSITION, Attribute::FLOAT32, 3, 4);
  add(Attribute::ID, Attribute::UINT32, 1, 4);
  add(Attribute::VELOCITY, Attribute::UINT16, 3, 2);
  return frame;
}

Scene makeScene(std::mt19937_64& random) {
  Scene scene;
  randomize(random, scene);
  scene.set_session(kSession);
  scene.set_epoch(1);
  return scene;
}

Journal makeJournal(std::mt19937_64& random, std::uint64_t number, int kind) {
  Journal journal;
  journal.set_session(kSession);
  journal.set_epoch(1);
  journal.set_number(number);
  journal.set_step(random() % 1000);
  journal.set_sim_time_s(randomDouble(random));
  if (kind == kRequestKinds) {
    randomize(random, *journal.mutable_instrument());
  } else if (kind == kRequestKinds + 1) {
    randomize(random, *journal.mutable_instrument_end());
  } else if (kind == kRequestKinds + 2) {
    journal.set_decision("slowed down");
  } else if (kind == kRequestKinds + 3) {
    randomize(random, *journal.mutable_restored());
  } else if (kind == kRequestKinds + 4) {
    randomize(random, *journal.mutable_switched());
  } else {
    Request& request = *journal.mutable_request()->mutable_request();
    randomize(random, request);
    journal.mutable_request()->set_object_id(7);
    const auto* field = Request::descriptor()->FindFieldByNumber(4 + kind);
    randomize(random, *request.GetReflection()->MutableMessage(&request, field));
  }
  return journal;
}

FrameStats makeStats(std::uint64_t seq, double emitted_ml) {
  FrameStats stats;
  stats.set_session(kSession);
  stats.set_seq(seq);
  stats.set_epoch(1);
  stats.set_emitted_ml(emitted_ml);
  stats.set_real_time_factor(2.0);
  return stats;
}

std::vector<Stored> writeRecording(const std::filesystem::path& path, std::size_t frames, std::size_t chunk_bytes) {
  std::mt19937_64 random{42};
  std::vector<Stored> out;
  WriterOptions options;
  options.chunk_bytes = chunk_bytes;
  auto writer = RecordingWriter::open(path, options);
  EXPECT_TRUE(writer.ok()) << writer.status().message();
  if (!writer) return out;
  std::uint64_t time = kStartNs;
  const auto put = [&](Topic topic, const auto& message) {
    auto sample = fromRecording(message);
    ASSERT_TRUE(sample.ok()) << sample.status().message();
    const auto status = writer->append(**sample, time);
    ASSERT_TRUE(status.ok()) << status.message();
    out.push_back({topic, message.SerializeAsString()});
    time += 1'000'000;
  };
  put(Topic::scene, makeScene(random));
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const auto seq = static_cast<std::uint64_t>(i + 1);
    put(Topic::frame, makeFrame(random, seq, static_cast<std::uint32_t>(random() % 60)));
    put(Topic::frame_stats, makeStats(seq, 0.25 * static_cast<double>(seq)));
    if (i % 3 == 0) {
      ++number;
      put(Topic::journal, makeJournal(random, number, static_cast<int>(i / 3 % kJournalKinds)));
    }
    if (i % 10 == 0) {
      recording::Status status;
      randomize(random, status);
      put(Topic::status, status);
    }
  }
  EXPECT_TRUE(writer->close().ok());
  return out;
}

}  // namespace bleedsim::recording::test
