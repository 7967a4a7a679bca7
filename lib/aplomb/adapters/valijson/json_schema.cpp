#include "aplomb/adapters/valijson/json_schema.h"

#include <nlohmann/json.hpp>
// Above, because Valijson's adapter header expects it.
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace aplomb::adapters {

std::optional<SchemaViolation> find_violation(std::string_view schema_text, std::string_view document_text) {
  const nlohmann::json schema_json = nlohmann::json::parse(schema_text),
                       document = nlohmann::json::parse(document_text);
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults results;
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results)) return std::nullopt;
  const valijson::ValidationResults::Error* innermost = nullptr;
  for (const auto& error : results)
    if (!innermost || error.context.size() > innermost->context.size()) innermost = &error;
  SchemaViolation violation;
  if (!innermost) return violation;
  violation.message = innermost->description;
  for (std::size_t i = 1; i < innermost->context.size(); ++i) {  // the first is "<root>"
    const std::string& step = innermost->context[i];             // "[key]"
    violation.path.push_back(step.substr(1, step.size() - 2));
  }
  return violation;
}

}  // namespace aplomb::adapters
