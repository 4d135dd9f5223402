#include <cstddef>
#include <fmt/format.h>

#include "service/scene/validate.h"
#include "service/status/printable_text.h"

namespace bleedsim::scene {
namespace {

void requirePrintable(std::string_view path, std::string_view text, int most_bytes, bool lines, ProblemList& problems) {
  if (text.size() > static_cast<std::size_t>(most_bytes)) {
    problems.add(path, fmt::format("has {} bytes, allowed are at most {}", text.size(), most_bytes));
  }
  if (const Status printable = checkPrintable(text, lines); !printable) problems.add(path, printable.message());
}

}  // namespace

bool requireName(std::string_view path, std::string_view name, ProblemList& problems) {
  const std::size_t before = problems.count();
  requirePrintable(path, name, kMaxNameBytes, false, problems);
  return problems.count() == before;
}

void validateText(const Scene& scene, ProblemList& problems) {
  requireName("name", scene.name(), problems);
  requireName("frame_id", scene.frame_id(), problems);
  requirePrintable("description", scene.description(), kMaxDescriptionBytes, true, problems);
}

}  // namespace bleedsim::scene
