#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aplomb::adapters {

/// What is wrong in a document, and where.
struct SchemaViolation {
  std::vector<std::string> path;  ///< keys and indices from the root; empty: the whole document
  std::string message;            ///< the validator's own words
};

/// The innermost violation of a JSON Schema (draft 7), or nothing where the document is valid. Valijson 1.0.
/// \pre Both texts are JSON, and the schema is a schema.
std::optional<SchemaViolation> find_violation(std::string_view schema, std::string_view document);

}  // namespace aplomb::adapters
