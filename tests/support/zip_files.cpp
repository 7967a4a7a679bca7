#include "support/zip_files.h"

#include <zlib.h>

#include <stdexcept>

namespace aplomb::test {
namespace {

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

std::string deflated(const std::string& data) {
  z_stream stream{};
  if (deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("zlib");
  std::string out(deflateBound(&stream, data.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// What the local and the central header share, from the version on.
std::string common_fields(const ZipEntry& entry, const std::string& stored) {
  std::string out;
  put(out, 20, 2);
  put(out, entry.flags, 2);
  put(out, static_cast<std::uint64_t>(entry.method >= 0 ? entry.method : entry.deflate ? 8 : 0), 2);
  put(out, (1 << 21 | 1 << 16), 4);  // 1980-01-01
  put(out, crc32(0, reinterpret_cast<const Bytef*>(entry.data.data()), static_cast<uInt>(entry.data.size())), 4);
  put(out, stored.size(), 4);
  put(out, entry.claimed_size >= 0 ? static_cast<std::uint64_t>(entry.claimed_size) : entry.data.size(), 4);
  put(out, entry.name.size(), 2);
  put(out, 0, 2);
  return out;
}

std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

std::string inflated(std::string_view data, std::size_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(size);
  const bool is_whole = inflateInit2(&stream, -15) == Z_OK && inflate(&stream, Z_FINISH) == Z_STREAM_END;
  inflateEnd(&stream);
  if (!is_whole) throw std::runtime_error("zlib");
  return out;
}

}  // namespace

std::string part_of(const std::vector<std::byte>& archive, std::string_view name) {
  const std::string_view bytes(reinterpret_cast<const char*>(archive.data()), archive.size());
  for (std::size_t at = 0; (at = bytes.find("PK\x01\x02", at)) != bytes.npos; at += 4) {  // the central directory
    if (bytes.substr(at + 46, number_at(bytes, at + 28, 2)) != name) continue;
    const std::size_t local = number_at(bytes, at + 42, 4), size = number_at(bytes, at + 20, 4);
    const std::size_t data = local + 30 + number_at(bytes, local + 26, 2) + number_at(bytes, local + 28, 2);
    const std::string_view stored = bytes.substr(data, size);
    return number_at(bytes, at + 10, 2) == 0 ? std::string(stored) : inflated(stored, number_at(bytes, at + 24, 4));
  }
  throw std::runtime_error("there is no such part: " + std::string(name));
}

std::string zip_of(const std::vector<ZipEntry>& entries) {
  std::string out, directory;
  for (const ZipEntry& entry : entries) {
    const std::string stored = entry.deflate ? deflated(entry.data) : entry.data;
    const std::size_t offset = out.size();
    out.append("PK\x03\x04").append(common_fields(entry, stored)).append(entry.name).append(stored);
    directory.append("PK\x01\x02");
    put(directory, 3 << 8 | 20, 2);  // made by Unix
    directory.append(common_fields(entry, stored));
    put(directory, 0, 6);
    put(directory, std::uint64_t{entry.unix_mode} << 16, 4);
    put(directory, offset, 4);
    directory.append(entry.name);
  }
  const std::size_t start = out.size();
  out.append(directory).append("PK\x05\x06");
  put(out, 0, 4);
  put(out, entries.size(), 2);
  put(out, entries.size(), 2);
  put(out, directory.size(), 4);
  put(out, start, 4);
  put(out, 0, 2);
  return out;
}

EndRecord end_record_of(const std::string& zip) {
  const std::size_t at = zip.rfind("PK\x05\x06");
  return {number_at(zip, at + 10, 2), number_at(zip, at + 12, 4), number_at(zip, at + 16, 4)};
}

std::string with_end_records(const std::string& zip, const EndRecord& plain, const std::optional<EndRecord>& zip64) {
  std::string out = zip.substr(0, zip.rfind("PK\x05\x06"));
  if (zip64) {
    const std::size_t record = out.size();
    out.append("PK\x06\x06");
    put(out, 44, 8);
    put(out, 45, 2);
    put(out, 45, 2);
    put(out, 0, 8);
    for (const std::uint64_t value : {zip64->entries, zip64->entries, zip64->size, zip64->offset}) put(out, value, 8);
    out.append("PK\x06\x07");
    put(out, 0, 4);
    put(out, record, 8);
    put(out, 1, 4);
  }
  out.append("PK\x05\x06");
  put(out, 0, 4);
  put(out, plain.entries, 2);
  put(out, plain.entries, 2);
  put(out, plain.size, 4);
  put(out, plain.offset, 4);
  put(out, 0, 2);
  return out;
}

std::vector<std::string> names_of_one_hash(int doublings) {
  std::vector<std::string> names{""};
  for (int i = 0; i < doublings; ++i) {
    std::vector<std::string> longer;
    for (const std::string& name : names)
      for (const char* pair : {"Bb", "CA"}) longer.push_back(name + pair);
    names = std::move(longer);
  }
  return names;
}

std::string package(std::string_view model, std::vector<ZipEntry> more) {
  more.push_back({"_rels/.rels",
                  R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
                  R"(<Relationship Target="/3D/3dmodel.model" Id="r0" )"
                  R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)"});
  more.push_back({"3D/3dmodel.model", std::string(model), true});
  return zip_of(more);
}

std::string model_xml(std::string_view resources, std::string_view build, std::string_view unit) {
  std::string xml = R"(<?xml version="1.0" encoding="UTF-8"?><model unit=")";
  xml.append(unit).append(R"(" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" )");
  xml.append(R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06"><resources>)");
  return xml.append(resources).append("</resources><build>").append(build).append("</build></model>");
}

std::string tetrahedron_object(int id, std::string_view attributes) {
  std::string xml = "<object id=\"";
  xml.append(std::to_string(id)).append("\" ").append(attributes).append("><mesh><vertices>");
  for (const char* at : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"})
    xml.append("<vertex x=\"")
        .append(1, at[0])
        .append("\" y=\"")
        .append(1, at[2])
        .append("\" z=\"")
        .append(1, at[4])
        .append("\"/>");
  xml.append("</vertices><triangles>");
  for (const char* t : {"021", "013", "032", "123"})
    xml.append("<triangle v1=\"")
        .append(1, t[0])
        .append("\" v2=\"")
        .append(1, t[1])
        .append("\" v3=\"")
        .append(1, t[2])
        .append("\"/>");
  return xml.append("</triangles></mesh></object>");
}

}  // namespace aplomb::test
