#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "aplomb/io/detail/read_context.h"

struct zip;  // libzip's

namespace aplomb::detail {

/// The parts of a zip that lies in memory. Nothing is ever unpacked to disk: a part's name is a key and no path.
/// Names are compared as the Open Packaging Conventions ask: without case and without a leading slash.
class ZipReader {
 public:
  /// \return unusable_input when the bytes are no zip.
  static Result<ZipReader> open(ReadContext& context);

  bool has(std::string_view name) const { return entries_.contains(key_of(name)); }
  /// The keys of all parts.
  const std::map<std::string, std::uint64_t>& entries() const { return entries_; }

  /// A part's bytes. What was read counts in the context's work bytes from then on.
  /// \return unusable_input when missing, ambiguous, encrypted, damaged, a link or compressed by a method other than
  ///         deflate; over_budget, also for what expands more than any model does; cancelled.
  Result<std::string> read(std::string_view name);

  static std::string key_of(std::string_view name);

 private:
  struct Closer {
    void operator()(::zip* archive) const;
  };
  static constexpr std::uint64_t kAmbiguous = ~std::uint64_t{0};

  explicit ZipReader(ReadContext& context) : context_(&context) {}
  Result<std::string> inflate(std::uint64_t index, std::size_t size, const std::string& place);

  ReadContext* context_;
  std::unique_ptr<::zip, Closer> archive_;
  std::map<std::string, std::uint64_t> entries_;
  double unpacked_ = 0;  // bytes, of all parts so far
};

}  // namespace aplomb::detail
