// What bleedctl prints with --json, read by a parser that is not ours.
#pragma once

#include <google/protobuf/struct.pb.h>
#include <string>

namespace bleedsim::client_test {

using Json = google::protobuf::Value;

/// The value of a whole text; null, and a failed test, when it is no JSON.
Json parseJson(const std::string& text);

/// A member of an object; null when it has no such member.
const Json& member(const Json& object, const std::string& key);
double number(const Json& object, const std::string& key);
std::string text(const Json& object, const std::string& key);

}  // namespace bleedsim::client_test
