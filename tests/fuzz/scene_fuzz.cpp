// Any text is answered: with every problem in short, printable lines, or with a scene whose text gives the same scene again.
#include <string>
#include <string_view>

#include "service/scene/scene.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bleedsim;
  using fuzz::require;
  const Result<scene::SceneDescription> parsed = scene::parseScene({reinterpret_cast<const char*>(data), size});
  if (!parsed) {
    require(parsed.status().code() == StatusCode::invalid_argument, "a bad scene is an invalid argument");
    require(!parsed.status().message().empty(), "a refusal has a reason");
    return 0;
  }
  const Result<scene::SceneDescription> again = scene::parseScene(parsed->normalized_text);
  require(again.ok(), "the normalised text is valid");
  require(again->normalized_text == parsed->normalized_text, "the normalised text gives itself");
  return 0;
}
