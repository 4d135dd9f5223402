#include "service/recording/scene_text.h"

#include <fmt/core.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

namespace bleedsim::recording {
namespace {

/// Keeps the first error, which would otherwise go to stderr.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, int column, const std::string& message) override {
    if (text_.empty()) text_ = fmt::format("line {}, column {}: {}", line + 1, column + 1, message);
  }
  void AddWarning(int /*line*/, int /*column*/, const std::string& /*message*/) override {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

Result<scene::Scene> readSceneText(const std::string& text) {
  google::protobuf::TextFormat::Parser parser;
  FirstError error;
  parser.RecordErrorsTo(&error);
  parser.AllowUnknownField(true);
  scene::Scene out;
  if (parser.ParseFromString(text, &out)) return out;
  return ::bleedsim::Status{StatusCode::data_loss, fmt::format("the recorded scene is no scene text: {}", error.text())};
}

}  // namespace bleedsim::recording
