// The members that samples share, in both directions; the first thing wrong is kept and named.
#pragma once

#include <cstddef>
#include <cstring>
#include <dds/ddsc/dds_public_alloc.h>
#include <fmt/core.h>
#include <string>
#include <string_view>

#include "idl/bleed.h"
#include "idl/recording.pb.h"
#include "service/recording/text_check.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// Sample -> message.
class ToMessage {
 public:
  const ::bleedsim::Status& status() const { return status_; }
  void fail(StatusCode code, std::string message) {
    if (status_.ok()) status_ = {code, std::move(message)};
  }

  void uuid(const bleed_v1_Uuid& in, std::string* out) { out->assign(reinterpret_cast<const char*>(in), sizeof(bleed_v1_Uuid)); }
  void vec3(const bleed_v1_Vec3& in, Vec3* out) {
    out->set_x(in.x);
    out->set_y(in.y);
    out->set_z(in.z);
  }
  template <std::size_t N>
  void text(const char* name, const char (&in)[N], std::string* out) {
    const std::size_t length = strnlen(in, N);
    if (length == N) return fail(StatusCode::invalid_argument, fmt::format("{} has no end; the sample is malformed", name));
    view(name, std::string_view{in, length}, out);
  }
  /// An unbounded string. Not an overload: it would be chosen for arrays, too.
  void longText(const char* name, const char* in, std::string* out) { view(name, in == nullptr ? std::string_view{} : in, out); }

  /// False: the sequence has a length but no data.
  template <class Sequence>
  bool has(const char* name, const Sequence& in) {
    if (in._length == 0) return false;
    if (in._buffer != nullptr) return true;
    fail(StatusCode::invalid_argument, fmt::format("{} has {} entries but no data; the sample is malformed", name, in._length));
    return false;
  }

 private:
  void view(const char* name, std::string_view in, std::string* out) {
    if (!isUtf8(in)) fail(StatusCode::invalid_argument, fmt::format("{} is not UTF-8 text; send plain text", name));
    out->assign(in);
  }

  ::bleedsim::Status status_;
};

/// Message -> sample; what it allocates belongs to the sample.
class ToSample {
 public:
  const ::bleedsim::Status& status() const { return status_; }
  void fail(std::string message) {
    if (status_.ok()) status_ = {StatusCode::data_loss, std::move(message)};
  }

  void uuid(const char* name, const std::string& in, bleed_v1_Uuid& out) {
    if (in.size() != sizeof(bleed_v1_Uuid)) return fail(fmt::format("{} has {} bytes instead of 16", name, in.size()));
    std::memcpy(out, in.data(), sizeof(bleed_v1_Uuid));
  }
  void vec3(const Vec3& in, bleed_v1_Vec3& out) { out = {in.x(), in.y(), in.z()}; }
  template <std::size_t N>
  void text(const char* name, const std::string& in, char (&out)[N]) {
    if (in.size() >= N) return fail(fmt::format("{} has {} bytes, more than {}", name, in.size(), N - 1));
    std::memcpy(out, in.data(), in.size());
    out[in.size()] = '\0';
  }
  void text(const std::string& in, char*& out) { out = dds_string_dup(in.c_str()); }

  /// Room for `count` entries, zeroed. False: nothing to fill.
  template <class Sequence>
  bool reserve(const char* name, int count, int bound, Sequence& out) {
    if (count > bound) {
      fail(fmt::format("{} has {} entries, more than {}", name, count, bound));
      return false;
    }
    return allocate(static_cast<std::size_t>(count), out);
  }
  template <class Sequence>
  bool allocate(std::size_t count, Sequence& out) {
    if (count == 0) return false;
    using Entry = std::remove_pointer_t<decltype(out._buffer)>;
    out._buffer = static_cast<Entry*>(dds_alloc(count * sizeof(Entry)));
    std::memset(out._buffer, 0, count * sizeof(Entry));
    out._length = out._maximum = static_cast<std::uint32_t>(count);
    out._release = true;
    return true;
  }

 private:
  ::bleedsim::Status status_;
};

/// The bodies of journal entries, in request_convert.cpp.
void requestToMessage(ToMessage& to, const bleed_v1_Request& in, Request& out);
void requestToSample(ToSample& to, const Request& in, bleed_v1_Request& out);

}  // namespace bleedsim::recording
