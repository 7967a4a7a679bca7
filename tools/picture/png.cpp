#include <png.h>

#include <csetjmp>
#include <string>

#include "aplomb/core/pulse.h"
#include "aplomb/io/atomic_file.h"
#include "picture.h"

namespace aplomb::picture {
namespace {

/// What libpng is called with, and may leave off in the middle of: by longjmp(), which destroys nothing.
struct Encoding {
  const Image& image;
  const Pulse& pulse;
  std::vector<std::byte>& bytes;  // with room for all
  std::string& problem;
  png_structp png = nullptr;
  png_infop info = nullptr;
};

void take(png_structp png, png_bytep data, png_size_t length) {
  auto& bytes = static_cast<Encoding*>(png_get_io_ptr(png))->bytes;
  if (length > bytes.capacity() - bytes.size()) png_error(png, "it is larger than it can be");
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), begin, begin + length);
}

void fail_with(png_structp png, png_const_charp message) {
  static_cast<Encoding*>(png_get_error_ptr(png))->problem = message;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

/// \return false where libpng failed.
bool encode(Encoding& e) {
  const auto width = static_cast<png_uint_32>(e.image.width), height = static_cast<png_uint_32>(e.image.height);
  if (setjmp(png_jmpbuf(e.png)) != 0) return false;
  png_set_write_fn(e.png, &e, take, nullptr);
  png_set_IHDR(e.png, e.info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(e.png, e.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(e.png, e.info);
  for (png_uint_32 y = 0; y < height && e.pulse.goes_on(width); ++y)
    png_write_row(e.png, e.image.rgb.data() + std::size_t{3} * width * y);
  if (!e.pulse.stopped()) png_write_end(e.png, e.info);
  return true;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image& image, const Job& job) {
  const Pulse pulse(job, 1, "picture");
  std::vector<std::byte> bytes;
  bytes.reserve(4096 + 4 * image.rgb.size());
  std::string problem = "no memory";
  Encoding encoding{image, pulse, bytes, problem};
  encoding.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoding, fail_with, ignore);
  if (encoding.png != nullptr) encoding.info = png_create_info_struct(encoding.png);
  const bool is_encoded = encoding.info != nullptr && encode(encoding);
  png_destroy_write_struct(&encoding.png, &encoding.info);
  if (!is_encoded) return fail(ErrorCode::third_party, "the picture cannot be encoded: " + problem);
  if (pulse.stopped()) return cancelled();
  return bytes;
}

Result<void> write_png(const std::string& path, const Image& image) {
  const auto bytes = encode_png(image);
  if (!bytes) return tl::unexpected(bytes.error());
  return write_file_atomically(path, *bytes);
}

}  // namespace aplomb::picture
