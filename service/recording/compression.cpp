#include "service/recording/compression.h"

#include <fmt/core.h>
#include <lz4frame.h>
#include <zstd.h>

namespace bleedsim::recording {
namespace {

::bleedsim::Status damaged(std::string message) { return {StatusCode::data_loss, std::move(message)}; }

}  // namespace

std::string_view nameOf(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "none";
    case Compression::lz4:
      return "lz4";
    case Compression::zstd:
      break;
  }
  return "zstd";
}

namespace mcap {
namespace {

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

::bleedsim::Status decompressLz4(ByteView bytes, std::vector<std::byte>& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0U) {
    return {StatusCode::internal, "no memory for the lz4 decompressor"};
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context{made};
  std::size_t read = 0;
  std::size_t filled = 0;
  for (;;) {
    std::size_t source = bytes.size() - read;
    std::size_t target = out.size() - filled;
    // A byte beyond the chunk, where a frame that is longer than it claims shows.
    std::byte beyond{};
    const bool full = target == 0;
    if (full) target = 1;
    const std::size_t hint =
        LZ4F_decompress(context.get(), full ? &beyond : out.data() + filled, &target, bytes.data() + read, &source, nullptr);
    if (LZ4F_isError(hint) != 0U) return damaged(fmt::format("a chunk does not decompress ({})", LZ4F_getErrorName(hint)));
    read += source;
    if (full && target > 0) return damaged(fmt::format("a chunk gives more than its {} bytes", out.size()));
    filled += target;
    if (hint == 0) break;
    if (source == 0 && target == 0) return damaged("a chunk does not decompress (its lz4 frame is incomplete)");
  }
  if (read != bytes.size()) return damaged("a chunk has bytes after its lz4 frame");
  if (filled != out.size()) return damaged(fmt::format("a chunk gives {} bytes instead of {}", filled, out.size()));
  return {};
}

}  // namespace

std::string chunkName(Compression compression) {
  return compression == Compression::none ? std::string{} : std::string{nameOf(compression)};
}

void Compressor::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }
void Decompressor::Free::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

Result<Compressor> Compressor::create(Compression compression, int zstd_level) {
  Compressor out;
  out.compression_ = compression;
  out.zstd_level_ = zstd_level;
  if (compression == Compression::zstd) {
    out.zstd_.reset(ZSTD_createCCtx());
    if (out.zstd_ == nullptr) return ::bleedsim::Status{StatusCode::internal, "no memory for the zstd compressor"};
  }
  return out;
}

::bleedsim::Status Compressor::lz4(std::string_view bytes) {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
  preferences.frameInfo.contentSize = bytes.size();
  preferences.frameInfo.blockSizeID = LZ4F_max4MB;
  out_.resize(LZ4F_compressFrameBound(bytes.size(), &preferences));
  const std::size_t size = LZ4F_compressFrame(out_.data(), out_.size(), bytes.data(), bytes.size(), &preferences);
  if (LZ4F_isError(size) != 0U) {
    return {StatusCode::internal,
            fmt::format("lz4 cannot compress a chunk of {} bytes: {}", bytes.size(), LZ4F_getErrorName(size))};
  }
  out_.resize(size);
  return {};
}

::bleedsim::Status Compressor::zstd(std::string_view bytes) {
  out_.resize(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compressCCtx(zstd_.get(), out_.data(), out_.size(), bytes.data(), bytes.size(), zstd_level_);
  if (ZSTD_isError(size) != 0U) {
    return {StatusCode::internal,
            fmt::format("zstd cannot compress a chunk of {} bytes: {}", bytes.size(), ZSTD_getErrorName(size))};
  }
  out_.resize(size);
  return {};
}

Result<std::string_view> Compressor::compress(std::string_view bytes) {
  if (compression_ == Compression::none) return bytes;
  const ::bleedsim::Status status = compression_ == Compression::lz4 ? lz4(bytes) : zstd(bytes);
  if (!status.ok()) return status;
  return std::string_view{out_};
}

Result<Decompressor> Decompressor::create() {
  Decompressor out;
  out.zstd_.reset(ZSTD_createDCtx());
  if (out.zstd_ == nullptr) return ::bleedsim::Status{StatusCode::internal, "no memory for the zstd decompressor"};
  return out;
}

::bleedsim::Status Decompressor::zstd(ByteView bytes, std::vector<std::byte>& out) {
  const std::size_t size = ZSTD_decompressDCtx(zstd_.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U) return damaged(fmt::format("a chunk does not decompress ({})", ZSTD_getErrorName(size)));
  if (size != out.size()) return damaged(fmt::format("a chunk gives {} bytes instead of {}", size, out.size()));
  return {};
}

::bleedsim::Status Decompressor::decompress(const std::string& name, ByteView bytes, std::size_t size,
                                            std::vector<std::byte>& out) {
  if (name.empty()) {
    if (bytes.size() != size) return damaged("an uncompressed chunk has two sizes");
    out.assign(bytes.begin(), bytes.end());
    return {};
  }
  if (name == chunkName(Compression::lz4)) {
    out.resize(size);
    return decompressLz4(bytes, out);
  }
  if (name != chunkName(Compression::zstd)) {
    return {StatusCode::unsupported, fmt::format("compressed with '{:.16}'; only none, lz4 and zstd are read", name)};
  }
  // The size is known before memory is taken: a frame that claims another one is refused.
  const unsigned long long claimed = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (claimed != ZSTD_CONTENTSIZE_UNKNOWN && claimed != size) return damaged("a chunk's size contradicts its compressed data");
  out.resize(size);
  return zstd(bytes, out);
}

}  // namespace mcap
}  // namespace bleedsim::recording
