// Pictures as PNG files, through libpng.
#pragma once

#include <filesystem>

#include "service/picture/image.h"
#include "service/status/status.h"

namespace bleedsim::picture {

/// Writes the picture beside the path and renames it into place: there is either the whole file or the one from before. The bytes
/// depend on the pixels alone. io: the folder is missing or not writable, the disk is full.
Status writePng(const std::filesystem::path& path, const Image& image);

/// Reads any PNG as 8-bit RGB; alpha is dropped. not_found: no such file; io: it cannot be read; data_loss: not a whole PNG;
/// invalid_argument: larger than an Image may be.
Result<Image> readPng(const std::filesystem::path& path);

}  // namespace bleedsim::picture
