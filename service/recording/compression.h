// How the chunks of a recording are compressed. The names are those of the MCAP format.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "service/recording/mcap_records.h"
#include "service/status/status.h"

struct ZSTD_CCtx_s;
struct ZSTD_DCtx_s;

namespace bleedsim::recording {

enum class Compression { none, lz4, zstd };

/// none, lz4 or zstd.
std::string_view nameOf(Compression compression);

namespace mcap {

/// As a chunk names it: empty for none.
std::string chunkName(Compression compression);

/// Not thread-safe: keeps its memory from call to call.
class Compressor {
 public:
  /// `zstd_level`: 1 to 19, of zstd alone. internal: no memory.
  static Result<Compressor> create(Compression compression, int zstd_level);

  Compression compression() const { return compression_; }
  /// What a chunk of these bytes holds; valid until the next call, and for none as long as `bytes`.
  Result<std::string_view> compress(std::string_view bytes);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  Compressor() = default;
  ::bleedsim::Status lz4(std::string_view bytes);
  ::bleedsim::Status zstd(std::string_view bytes);

  Compression compression_ = Compression::none;
  int zstd_level_ = 1;
  std::unique_ptr<ZSTD_CCtx_s, Free> zstd_;
  std::string out_;
};

/// Reads all of them. Not thread-safe.
class Decompressor {
 public:
  /// internal: no memory.
  static Result<Decompressor> create();

  /// `out` becomes the `size` bytes of a chunk. data_loss: the bytes are no such data, or hold another number of bytes;
  /// unsupported: there is no compression of that name. The message does not name the file.
  ::bleedsim::Status decompress(const std::string& name, ByteView bytes, std::size_t size, std::vector<std::byte>& out);

 private:
  struct Free {
    void operator()(ZSTD_DCtx_s* context) const;
  };
  Decompressor() = default;
  ::bleedsim::Status zstd(ByteView bytes, std::vector<std::byte>& out);

  std::unique_ptr<ZSTD_DCtx_s, Free> zstd_;
};

}  // namespace mcap
}  // namespace bleedsim::recording
