// The bytes of an archive. The mutator knows its records: it copies and drops them, and lets their fields lie.
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "check_mesh.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace aplomb;

/// Where local and central headers, end records of both kinds and locators begin.
std::vector<std::size_t> records_of(const std::string& zip) {
  std::vector<std::size_t> found;
  for (std::size_t at = 0; (at = zip.find("PK", at)) != zip.npos; ++at)
    for (const std::string_view kind : {"\1\2", "\3\4", "\5\6", "\6\6", "\6\7"})
      if (zip.compare(at + 2, 2, kind) == 0) found.push_back(at);
  return found;
}

/// A number that some field may mean something by: sizes, offsets of records, the ends of ranges.
std::uint64_t telling_number(const std::string& zip, const std::vector<std::size_t>& records, std::mt19937& random) {
  switch (random() % 6) {
    case 0:
      return 0;
    case 1:
      return ~std::uint64_t{0};
    case 2:
      return std::uint64_t{1} << random() % 64;
    case 3:
      return zip.size();
    case 4:
      return random() % 100;
    default:
      return records[random() % records.size()];
  }
}

void change_field(std::string& zip, const std::vector<std::size_t>& records, std::mt19937& random) {
  constexpr std::size_t kLongestRecord = 56;
  const std::size_t at = records[random() % records.size()] + 4 + 2 * (random() % (kLongestRecord / 2 - 2));
  const std::size_t bytes = std::size_t{2} << random() % 3;
  const std::uint64_t value = telling_number(zip, records, random);
  for (std::size_t i = 0; i < bytes && at + i < zip.size(); ++i) zip[at + i] = static_cast<char>(value >> 8 * i);
}

void mutate(std::string& zip, std::mt19937& random) {
  const std::vector<std::size_t> records = records_of(zip);
  if (records.empty()) return;
  const std::size_t chosen = random() % records.size();
  const std::size_t from = records[chosen], to = chosen + 1 < records.size() ? records[chosen + 1] : zip.size();
  const unsigned way = random() % 8;
  if (way < 5) return change_field(zip, records, random);
  if (way == 5) zip.erase(from, to - from);
  else zip.insert(way == 6 ? zip.size() : records[random() % records.size()], zip.substr(from, to - from));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  std::mt19937 random(seed);
  if (random() % 3 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string zip(reinterpret_cast<const char*>(data), size);
  mutate(zip, random);
  if (zip.empty() || zip.size() > most) return LLVMFuzzerMutate(data, size, most);
  zip.copy(reinterpret_cast<char*>(data), zip.size());
  return zip.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::check_mesh({reinterpret_cast<const std::byte*>(data), size}, "a.3mf");
  return 0;
}
