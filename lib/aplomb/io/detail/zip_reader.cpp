#include "aplomb/io/detail/zip_reader.h"

#include <zip.h>

#include <algorithm>
#include <utility>

namespace aplomb::detail {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;
// Model text shrinks 5 to 50 times; a bomb a thousand times.
constexpr double kMostExpansion = 200;
constexpr double kSmallPart = 64 << 20;

constexpr std::size_t kMostDirectory = std::size_t{16} << 20;

std::uint64_t little_endian(std::string_view bytes, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = std::min(count, bytes.size()); i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// The largest central directory that any end record among the last bytes claims (APPNOTE 4.3.14 to 4.3.16): libzip
/// takes some 300 bytes for each of its entries as soon as it opens it.
std::uint64_t directory_bytes(std::string_view text) {
  constexpr std::size_t kSearched = 70'000;  // a record, and its comment of at most 65,535
  std::uint64_t most = 0;
  for (std::size_t at = text.size() - std::min(text.size(), kSearched); (at = text.find("PK\5\6", at)) != text.npos;
       ++at) {
    std::uint64_t size = little_endian(text.substr(std::min(text.size(), at + 12)), 4);
    if (size == 0xffffffff && at >= 20) {
      const std::uint64_t record = little_endian(text.substr(at - 20 + 8), 8);
      size =
          record < text.size() ? little_endian(text.substr(std::min<std::size_t>(text.size(), record + 40)), 8) : size;
    }
    most = std::max(most, size);
  }
  return most;
}

bool is_symbolic_link(zip_t* archive, zip_uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  constexpr zip_uint32_t kTypeMask = 0170000, kLink = 0120000;
  return zip_file_get_external_attributes(archive, index, 0, &system, &attributes) == 0 && system == ZIP_OPSYS_UNIX &&
         ((attributes >> 16) & kTypeMask) == kLink;
}

}  // namespace

void ZipReader::Closer::operator()(zip_t* archive) const { zip_discard(archive); }

std::string ZipReader::key_of(std::string_view name) {
  while (name.starts_with('/') || name.starts_with('\\')) name.remove_prefix(1);
  std::string key(name);
  for (char& c : key) c = c == '\\' ? '/' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return key;
}

Result<ZipReader> ZipReader::open(ReadContext& context) {
  if (directory_bytes(context.text()) > kMostDirectory)
    return context.unusable("", "its zip claims a directory of more than 16 MB, as no 3MF has; export the model again");
  ZipReader reader(context);
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(context.bytes().data(), context.bytes().size(), 0, &error);
  if (source) reader.archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (!reader.archive_) {
    if (source) zip_source_free(source);
    return context.unusable("", "it cannot be opened as a zip, which a 3MF is (" + reason + "); save it again");
  }
  const zip_int64_t count = zip_get_num_entries(reader.archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(reader.archive_.get(), static_cast<zip_uint64_t>(i), 0);
    if (!name) continue;
    const auto [at, is_new] = reader.entries_.try_emplace(key_of(name), static_cast<std::uint64_t>(i));
    if (!is_new) at->second = kAmbiguous;
  }
  return reader;
}

Result<std::string> ZipReader::read(std::string_view name) {
  const auto entry = entries_.find(key_of(name));
  const std::string place = "part " + in_quotes(name);
  if (entry == entries_.end()) return context_->unusable(place, "there is no such part; export the model again");
  if (entry->second == kAmbiguous)
    return context_->unusable(place, "the zip holds two parts of this name; export the model again");
  zip_stat_t status;
  zip_stat_init(&status);
  if (zip_stat_index(archive_.get(), entry->second, 0, &status) != 0 || !(status.valid & ZIP_STAT_SIZE) ||
      !(status.valid & ZIP_STAT_COMP_SIZE))
    return context_->unusable(place, "its entry in the zip is damaged; export the model again");
  if (status.encryption_method != ZIP_EM_NONE)
    return context_->unusable(place, "it is encrypted; export the model without a password");
  if (status.comp_method != ZIP_CM_STORE && status.comp_method != ZIP_CM_DEFLATE)
    return context_->unusable(place, "it is compressed by a method that 3MF does not allow; export the model again");
  if (is_symbolic_link(archive_.get(), entry->second))
    return context_->unusable(place, "it is a symbolic link, which a 3MF cannot hold; export the model again");
  // Of each part, and of all together: parts may share the bytes that they unpack from.
  unpacked_ += static_cast<double>(status.size);
  for (const auto& [size, packed] : {std::pair{static_cast<double>(status.size), status.comp_size},
                                     {unpacked_, static_cast<zip_uint64_t>(context_->bytes().size())}})
    if (const double fold = size / static_cast<double>(std::max<zip_uint64_t>(1, packed));
        size > kSmallPart && fold > kMostExpansion)
      return fail(ErrorCode::over_budget, context_->name() + ", " + place + ": it expands " +
                                              std::to_string(static_cast<long long>(fold)) +
                                              "-fold, as no model does; export it again");
  if (auto admitted = context_->admit(0, 0, status.size); !admitted) return tl::unexpected<Error>(admitted.error());
  return inflate(entry->second, status.size, place);
}

Result<std::string> ZipReader::inflate(std::uint64_t index, std::size_t size, const std::string& place) {
  const auto damaged = [&](const std::string& reason) {
    return context_->unusable(place, "it cannot be unpacked (" + reason + "); the file is damaged, save it again");
  };
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive_.get(), index, 0), zip_fclose);
  if (!file) return damaged(zip_strerror(archive_.get()));
  context_->set_work_bytes(context_->work_bytes() + size);
  std::string text;
  for (;;) {
    if (!context_->proceed(0.3 * static_cast<double>(text.size()) / static_cast<double>(size + 1))) return cancelled();
    const std::size_t before = text.size();
    text.resize(std::min(before + kChunk, size + 1));  // one more than promised: reads the end, and sees a lie
    const zip_int64_t got = zip_fread(file.get(), text.data() + before, text.size() - before);
    if (got < 0) return damaged(zip_file_strerror(file.get()));
    text.resize(before + static_cast<std::size_t>(got));
    if (text.size() > size) return damaged("longer than its entry says");
    if (got == 0) break;
  }
  if (text.size() != size) return damaged("shorter than its entry says");
  return text;
}

}  // namespace aplomb::detail
