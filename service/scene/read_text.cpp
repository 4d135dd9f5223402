#include "service/scene/read_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/text_format.h>
#include <string>
#include <vector>

#include "service/scene/nearest_name.h"

namespace bleedsim::scene {
namespace {

// Scene messages nest four deep; the rest is room for unknown ones that are skipped.
constexpr int kMaxNesting = 16;

/// The text between the quotes number 2n and 2n + 1; empty if there are not as many.
std::string quoted(const std::string& text, int n) {
  std::size_t start = 0;
  for (int i = 0;; ++i) {
    start = text.find('"', start);
    const std::size_t end = start == std::string::npos ? start : text.find('"', start + 1);
    if (end == std::string::npos) return {};
    if (i == n) return text.substr(start + 1, end - start - 1);
    start = end + 1;
  }
}

/// Rewords protobuf's "Message type "T" has no field named "F"."; any other message is passed on.
std::string explain(const std::string& message) {
  if (message.find("has no field named") == std::string::npos) return message;
  const google::protobuf::Descriptor* type =
      google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(quoted(message, 0));
  const std::string field = quoted(message, 1);
  if (type == nullptr || field.empty()) return message;
  std::vector<std::string> known;
  for (int i = 0; i < type->field_count(); ++i) known.push_back(type->field(i)->name());
  const std::string nearest = nearestName(field, known);
  const std::string start = fmt::format("unknown field '{}' in {}", field.substr(0, 64), type->name());
  return nearest.empty() ? fmt::format("{}; known are {}", start, fmt::join(known, ", "))
                         : fmt::format("{}; did you mean '{}'?", start, nearest);
}

/// Messages quote the text, which may hold any byte.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

class TextProblems final : public google::protobuf::io::ErrorCollector {
 public:
  explicit TextProblems(ProblemList& problems) : problems_{problems} {}

  void AddError(int line, google::protobuf::io::ColumnNumber column, const std::string& message) override {
    if (problems_.full()) {
      problems_.add("", "");
      return;
    }
    // A line below 0 is protobuf's way of speaking about the whole text.
    const std::string where = line < 0 ? "text" : fmt::format("line {}:{}", line + 1, column + 1);
    problems_.add(where, printable(explain(message)));
  }
  // The parser warns about what it is told to skip: unknown fields.
  void AddWarning(int line, google::protobuf::io::ColumnNumber column, const std::string& message) override {
    AddError(line, column, message);
  }

 private:
  ProblemList& problems_;
};

}  // namespace

bool readText(std::string_view text, google::protobuf::Message& message, ProblemList& problems) {
  TextProblems collector{problems};
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.AllowUnknownField(true);
  parser.SetRecursionLimit(kMaxNesting);
  google::protobuf::io::ArrayInputStream stream{text.data(), static_cast<int>(text.size())};
  return parser.Parse(&stream, &message);
}

std::string writeText(const google::protobuf::Message& message) {
  google::protobuf::TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  std::string text;
  printer.PrintToString(message, &text);
  return text;
}

}  // namespace bleedsim::scene
