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

// Projects of several plates have hundreds of parts. libzip takes 300 bytes for each as soon as it opens the directory,
// finds names by a hash that a file can make collide, and reads the directory again for each end record.
constexpr std::size_t kMostDirectory = std::size_t{1} << 20;
constexpr std::uint64_t kMostParts = 5000;

std::uint64_t little_endian(std::string_view text, std::uint64_t at, std::size_t count) {
  const std::string_view bytes = text.substr(std::min<std::uint64_t>(text.size(), at), count);
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// What an end record says of the directory, or what the directory holds where that is more.
struct Directory {
  std::uint64_t entries = 0, bytes = 0, offset = 0;

  std::uint64_t true_entries(std::string_view text) const {
    const std::string_view bytes_of_it = text.substr(std::min<std::uint64_t>(text.size(), offset), bytes);
    std::uint64_t found = 0;
    for (std::size_t at = 0; (at = bytes_of_it.find("PK\1\2", at)) != bytes_of_it.npos; at += 4) ++found;
    return std::max(found, entries);
  }
};

/// By the end record at `at` (APPNOTE 4.3.14 to 4.3.16). Where a locator stands before it, libzip believes the record
/// of 64 bits, whatever the plain one says.
Directory directory_by(std::string_view text, std::size_t at) {
  constexpr std::size_t kLocator = 20;
  if (at >= kLocator && text.substr(at - kLocator, 4) == "PK\6\7") {
    const std::uint64_t record = little_endian(text, at - kLocator + 8, 8);
    if (record > text.size()) return {};  // libzip refuses that
    return {std::max(little_endian(text, record + 24, 8), little_endian(text, record + 32, 8)),
            little_endian(text, record + 40, 8), little_endian(text, record + 48, 8)};
  }
  return {std::max(little_endian(text, at + 8, 2), little_endian(text, at + 10, 2)), little_endian(text, at + 12, 4),
          little_endian(text, at + 16, 4)};
}

/// Whether all directories that end records among the last bytes name are small, together.
bool has_small_directory(std::string_view text) {
  constexpr std::size_t kSearched = 70'000;  // a record, and its comment of at most 65,535
  std::uint64_t bytes = 0, entries = 0;
  for (std::size_t at = text.size() - std::min(text.size(), kSearched); (at = text.find("PK\5\6", at)) != text.npos;
       ++at) {
    const Directory directory = directory_by(text, at);
    if (directory.bytes > kMostDirectory || (bytes += directory.bytes) > kMostDirectory) return false;
    if (directory.entries > kMostParts || (entries += directory.true_entries(text)) > kMostParts) return false;
  }
  return true;
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
  if (!has_small_directory(context.text()))
    return context.unusable("", "its zip has a directory of more than 5000 parts or 1 MB; export fewer models at once");
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
  text.reserve(size + 1);  // as admitted: grown step by step it would be held twice
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
