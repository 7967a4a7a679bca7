#include <png.h>

#include "aplomb/io/atomic_file.h"
#include "picture.h"

namespace aplomb::picture {

Result<std::vector<std::byte>> encode_png(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    return fail(ErrorCode::third_party, std::string("the picture cannot be encoded: ") + header.message);
  bytes.resize(size);
  return bytes;
}

Result<void> write_png(const std::string& path, const Image& image) {
  const auto bytes = encode_png(image);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_file_atomically(path, *bytes);
}

}  // namespace aplomb::picture
