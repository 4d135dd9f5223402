#include "service/lab/case_names.h"

#include <algorithm>

namespace bleedsim::lab {

Result<std::vector<const ValidationCase*>> casesOf(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (findCase(name) != nullptr) continue;
    std::string known;
    for (const ValidationCase& one : validationCases()) known += (known.empty() ? "" : ", ") + std::string{one.name};
    return Status{StatusCode::not_found, "no case '" + name + "'; the cases are " + known};
  }
  std::vector<const ValidationCase*> cases;
  for (const ValidationCase& one : validationCases()) {
    if (names.empty() || std::find(names.begin(), names.end(), one.name) != names.end()) cases.push_back(&one);
  }
  return cases;
}

}  // namespace bleedsim::lab
