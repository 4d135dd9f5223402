// Samples of every topic that a client reads, as the middleware may give them: any numbers, unterminated texts, lengths without
// data; sequences and texts lie in memory of exactly their length. Taken as values of the library and into a recording.
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "clients/lib/convert.h"
#include "service/recording/convert.h"
#include "tests/fuzz/request_bytes.h"

namespace {

using namespace bleedsim;
using fuzz::FuzzInput;

/// What the sequences and texts of one sample point to.
class SampleMemory {
 public:
  /// Up to `bound` elements; a count of one more than that is a length without data.
  template <class Sequence>
  void fill(FuzzInput& input, std::size_t bound, Sequence& sequence) {
    using Element = std::remove_pointer_t<decltype(sequence._buffer)>;
    const std::size_t asked = input.take<std::uint16_t>() % (bound + 2);
    if (asked > bound) {
      sequence = {1, 1, nullptr, false};
      return;
    }
    const std::size_t count = std::min(asked, input.rest().size() / sizeof(Element));
    auto* elements = reinterpret_cast<Element*>(block(count * sizeof(Element)));
    for (std::size_t i = 0; i < count; ++i) input.takeInto(elements[i]);
    const auto length = static_cast<std::uint32_t>(count);
    sequence = {length, length, elements, false};
  }
  char* text(FuzzInput& input) {
    const std::size_t length = std::min<std::size_t>(input.take<std::uint16_t>(), input.rest().size());
    if (length == 0) return nullptr;
    auto* text = reinterpret_cast<char*>(block(length + 1));
    for (std::size_t i = 0; i < length; ++i) input.takeInto(text[i]);
    text[length] = '\0';
    return text;
  }

 private:
  std::uint8_t* block(std::size_t bytes) {
    if (bytes == 0) return nullptr;
    return blocks_.emplace_back(std::make_unique<std::uint8_t[]>(bytes)).get();
  }
  std::vector<std::unique_ptr<std::uint8_t[]>> blocks_;
};

/// A recording refuses the sample with its reason, or stores what can be read back.
template <class Message, class Sample>
void record(const Sample& sample) {
  Message message;
  const Status taken = recording::toRecording(sample, message);
  if (!taken) {
    fuzz::require(taken.code() == StatusCode::invalid_argument || taken.code() == StatusCode::unsupported,
                  "a refusal has its code");
    fuzz::require(!taken.message().empty(), "a refusal has a reason");
    return;
  }
  const auto same = recording::fromRecording(message);
  fuzz::require(same.ok(), "what was recorded can be read back");
  Message again;
  fuzz::require(recording::toRecording(**same, again).ok(), "what was read back can be recorded");
  fuzz::require(again.SerializeAsString() == message.SerializeAsString(), "both ways keep every bit");
}

void takeFrame(FuzzInput& input) {
  bleed_v1_Frame sample{};
  SampleMemory memory;
  input.takeInto(sample);
  memory.fill(input, 16, sample.attributes);
  memory.fill(input, 4096, sample.payload);
  record<recording::Frame>(sample);
}

void takeStats(FuzzInput& input) {
  bleed_v1_FrameStats sample{};
  SampleMemory memory;
  input.takeInto(sample);
  memory.fill(input, 32, sample.stage_costs);
  memory.fill(input, 1024, sample.wounds);
  memory.fill(input, 64, sample.fault_counters);
  memory.fill(input, 64, sample.instruments);
  const client::FrameStats stats = client::fromWire(sample);
  fuzz::require(sample.wounds._buffer == nullptr || stats.wounds.size() == sample.wounds._length, "all ledgers are taken");
  record<recording::FrameStats>(sample);
}

void takeStatus(FuzzInput& input) {
  bleed_v1_Status sample{};
  SampleMemory memory;
  input.takeInto(sample);
  memory.fill(input, 64, sample.counters);
  memory.fill(input, 32, sample.clients);
  memory.fill(input, 32, sample.checkpoints);
  const client::SessionStatus status = client::fromWire(sample);
  fuzz::require(std::strlen(client::toString(status.state)) > 0, "every state has a name");
  fuzz::require(status.text.size() <= sizeof sample.text, "a text ends with its member");
  record<recording::Status>(sample);
}

void takeScene(FuzzInput& input) {
  bleed_v1_Scene sample{};
  SampleMemory memory;
  input.takeInto(sample);
  memory.fill(input, 64, sample.effects);
  memory.fill(input, 64, sample.known_effects);
  sample.scene_text = memory.text(input);
  sample.loaded_text = memory.text(input);
  const client::SceneInfo scene = client::fromWire(sample);
  fuzz::require(sample.effects._buffer == nullptr || scene.effects.size() == sample.effects._length, "all effects are taken");
  record<recording::Scene>(sample);
}

void takeReply(FuzzInput& input) {
  bleed_v1_Reply sample{};
  input.takeInto(sample);
  const client::Reply reply = client::fromWire(sample);
  fuzz::require(reply.accepted() == (sample.code == bleed_v1_REPLY_ACCEPTED), "only what was accepted counts as that");
  fuzz::require(std::strlen(client::toString(reply.code)) > 0, "every code has a name");
}

void takeJournal(FuzzInput& input) {
  bleed_v1_Journal sample{};
  fuzz::RequestBytes request;
  input.takeInto(sample.session);
  sample.epoch = input.take<std::uint32_t>();
  sample.number = input.take<std::uint64_t>();
  sample.step = input.take<std::uint64_t>();
  sample.sim_time_s = input.take<double>();
  const auto kind = input.take<std::uint8_t>();
  sample.body._d = kind < 255 ? kind % 8U : input.take<std::uint32_t>();
  auto& body = sample.body._u;
  if (sample.body._d == bleed_v1_JOURNAL_REQUEST) {
    body.request.object_id = input.take<std::uint32_t>();
    input.takeInto(body.request.request.client);
    body.request.request.run = input.take<std::uint64_t>();
    body.request.request.seq = input.take<std::uint64_t>();
    request.fill(input, body.request.request.body);
  } else {
    input.takeInto(body);
  }
  record<recording::Journal>(sample);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr void (*kTake[])(FuzzInput&) = {takeFrame, takeStats, takeStatus, takeScene, takeReply, takeJournal};
  FuzzInput input{data, size};
  kTake[input.take<std::uint8_t>() % std::size(kTake)](input);
  return 0;
}
