#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Zip archives made byte by byte, so that they can be wrong in every field; and 3MF packages in them.
namespace aplomb::test {

struct ZipEntry {
  std::string name;
  std::string data;
  bool deflate = false;
  std::uint16_t flags = 0;         ///< 1: encrypted
  int method = -1;                 ///< claimed method; -1: the true one
  std::int64_t claimed_size = -1;  ///< claimed uncompressed size; -1: the true one
  std::uint32_t unix_mode = 0100644;
};

std::string zip_of(const std::vector<ZipEntry>& entries);

/// What an end record says of the central directory.
struct EndRecord {
  std::uint64_t entries = 0, size = 0, offset = 0;
};

EndRecord end_record_of(const std::string& zip);

/// The archive with another end record, and with a record of 64 bits and its locator before it where one is given.
std::string with_end_records(const std::string& zip, const EndRecord& plain,
                             const std::optional<EndRecord>& zip64 = std::nullopt);

/// 2^doublings names of one hash to libzip 1.7 (h * 33 + c, unseeded).
std::vector<std::string> names_of_one_hash(int doublings);

/// What an entry of a sound archive holds, deflated or not; throws where there is none.
std::string part_of(const std::vector<std::byte>& archive, std::string_view name);

/// A package whose root model part is `model`, with further parts.
std::string package(std::string_view model, std::vector<ZipEntry> more = {});

/// A <model> with these resources and build, the production extension declared as p.
std::string model_xml(std::string_view resources, std::string_view build, std::string_view unit = "millimeter");

/// An <object> that is the tetrahedron (0 0 0) (1 0 0) (0 1 0) (0 0 1), of volume 1/6.
std::string tetrahedron_object(int id, std::string_view attributes = "");

}  // namespace aplomb::test
