#include <png.h>

#include "picture.h"

namespace aplomb::picture {

Result<void> write_png(const std::string& path, const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&header, path.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
    return fail(ErrorCode::file_system, path + ": cannot be written (" + header.message + ")");
  }
  return {};
}

}  // namespace aplomb::picture
