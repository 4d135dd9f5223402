// Builds JSON text: an object or array at a time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace bleedsim::bleedctl {

/// With quotes; control characters are escaped.
std::string jsonString(std::string_view text);
/// The shortest text that reads back equal; null when not finite.
std::string jsonNumber(double value);

class JsonObject {
 public:
  JsonObject& add(std::string_view key, std::string_view value) { return raw(key, jsonString(value)); }
  JsonObject& add(std::string_view key, const char* value) { return raw(key, jsonString(value)); }
  JsonObject& add(std::string_view key, double value) { return raw(key, jsonNumber(value)); }
  JsonObject& add(std::string_view key, std::uint64_t value) { return raw(key, std::to_string(value)); }
  JsonObject& add(std::string_view key, std::uint32_t value) { return raw(key, std::to_string(value)); }
  JsonObject& add(std::string_view key, std::int32_t value) { return raw(key, std::to_string(value)); }
  JsonObject& add(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
  /// `json` is JSON already.
  JsonObject& raw(std::string_view key, std::string_view json);
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

class JsonArray {
 public:
  JsonArray& raw(std::string_view json);
  std::string text() const { return "[" + items_ + "]"; }

 private:
  std::string items_;
};

}  // namespace bleedsim::bleedctl
