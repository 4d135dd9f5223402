#include "service/picture/png_file.h"

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <png.h>
#include <unistd.h>
#include <vector>

#include "service/status/file_error.h"

namespace bleedsim::picture {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// libpng reports errors by a jump. Between setjmp and the jump no object with a destructor may be made: the functions that
// contain a setjmp own nothing, and everything they use is made by their callers.
struct PngError {
  char message[200] = "";
};

void keepError(png_structp png, png_const_charp message) {
  auto* error = static_cast<PngError*>(png_get_error_ptr(png));
  std::snprintf(error->message, sizeof error->message, "%s", message);
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

struct Writer {
  explicit Writer(PngError& error) : png{png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, keepError, ignoreWarning)} {
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }

  png_structp png;
  png_infop info = nullptr;
};

struct Reader {
  explicit Reader(PngError& error) : png{png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, keepError, ignoreWarning)} {
    if (png != nullptr) info = png_create_info_struct(png);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  png_structp png;
  png_infop info = nullptr;
};

bool writeRows(Writer& writer, std::FILE* file, png_uint_32 width, png_uint_32 height, png_bytepp rows) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_init_io(writer.png, file);
  png_set_IHDR(writer.png, writer.info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
               PNG_FILTER_TYPE_BASE);
  png_set_compression_level(writer.png, 6);
  png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(writer.png, writer.info);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, writer.info);
  return true;
}

bool readHeader(Reader& reader, std::FILE* file, png_uint_32& width, png_uint_32& height) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_init_io(reader.png, file);
  png_set_user_limits(reader.png, Image::kMostSide, Image::kMostSide);
  png_read_info(reader.png, reader.info);
  width = png_get_image_width(reader.png, reader.info);
  height = png_get_image_height(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_scale_16(reader.png);
  png_set_strip_alpha(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return png_get_rowbytes(reader.png, reader.info) == 3 * static_cast<std::size_t>(width);
}

bool readRows(Reader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

std::vector<png_bytep> rowsOf(Image& image) {
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height()));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = image.bytes().data() + 3 * y * static_cast<std::size_t>(image.width());
  return rows;
}

Status ioError(const char* action, const std::filesystem::path& path, int error) {
  return {StatusCode::io, std::string{"cannot "} + action + " '" + path.string() + "': " + fileErrorText(error)};
}

Status outOfMemory(const std::filesystem::path& path) {
  return {StatusCode::capacity, "cannot handle '" + path.string() + "': out of memory; choose a smaller picture"};
}

Status writeTo(const std::filesystem::path& path, const std::filesystem::path& shown, const Image& image) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return ioError("create", shown, errno);
  File file{::fdopen(descriptor, "wb")};
  if (!file) {
    const int error = errno;
    ::close(descriptor);
    return ioError("create", shown, error);
  }
  PngError error;
  Writer writer{error};
  if (writer.info == nullptr) return outOfMemory(shown);
  Image copy = image;  // libpng wants rows that it could write to
  std::vector<png_bytep> rows = rowsOf(copy);
  errno = 0;
  const auto width = static_cast<png_uint_32>(image.width());
  const auto height = static_cast<png_uint_32>(image.height());
  if (!writeRows(writer, file.get(), width, height, rows.data())) {
    if (errno != 0) return ioError("write to", shown, errno);
    return {StatusCode::io, "cannot write '" + shown.string() + "': " + error.message + "; free space or choose another disk"};
  }
  // A full disk may show only when the buffer goes out.
  if (std::fclose(file.release()) != 0) return ioError("write to", shown, errno);
  return {};
}

}  // namespace

Status writePng(const std::filesystem::path& path, const Image& image) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return ioError("write to", path, EISDIR);
  std::filesystem::path part = path;
  part += ".part" + std::to_string(::getpid());
  const Status written = writeTo(part, path, image);
  if (!written.ok()) {
    std::filesystem::remove(part, error);
    return written;
  }
  std::filesystem::rename(part, path, error);
  if (!error) return {};
  const int reason = error.value();
  std::filesystem::remove(part, error);
  return ioError("write to", path, reason);
}

Result<Image> readPng(const std::filesystem::path& path) {
  const File file{std::fopen(path.c_str(), "rbe")};
  if (!file) {
    if (errno == ENOENT) {
      return Status{StatusCode::not_found, "there is no file '" + path.string() + "'; check its name and folder"};
    }
    return ioError("read", path, errno);
  }
  const auto damaged = [&path](const PngError& error) {
    return Status{StatusCode::data_loss,
                  std::string{"'"} + path.string() + "' is not a whole PNG file (" + error.message + "); write it again"};
  };
  PngError error;
  Reader reader{error};
  if (reader.info == nullptr) return outOfMemory(path);
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  if (!readHeader(reader, file.get(), width, height)) return damaged(error);
  Result<Image> image = Image::create(static_cast<int>(width), static_cast<int>(height));
  if (!image) return image;
  std::vector<png_bytep> rows = rowsOf(*image);
  if (!readRows(reader, rows.data())) return damaged(error);
  return image;
}

}  // namespace bleedsim::picture
