// One visitor made of a lambda for each alternative of a variant.
#pragma once

namespace bleedsim::dds {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang 14 does not deduce aggregates by itself

}  // namespace bleedsim::dds
