#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "aplomb/adapters/valijson/json_schema.h"
#include "aplomb/core/printable.h"
#include "aplomb/job/job_file.h"

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;  // the schema, whose keys are told in its order; it searches all of them for each
using Document = nlohmann::json;

/// A value and the part of the schema that speaks of it.
struct JobPlace {
  std::string name;  ///< "poses[0].stand"
  const Document* value = nullptr;
  const Json* schema = nullptr;
};

const Json* child_schema(const Json& root, const Json& schema, const std::string& step, bool is_index) {
  const Json* child = nullptr;
  if (is_index && schema.contains("items")) child = &schema["items"];
  else if (!is_index && schema.contains("properties") && schema["properties"].contains(step))
    child = &schema["properties"][step];
  if (child && child->contains("$ref"))
    child = &root.at(Json::json_pointer((*child)["$ref"].get<std::string>().substr(1)));
  return child;
}

/// Follows the path as far as the schema speaks of single values.
JobPlace place_of(const Json& root, const Document& document, const std::vector<std::string>& path) {
  JobPlace place{"", &document, &root};
  for (const std::string& step : path) {
    const bool is_index = place.value->is_array();
    const Json* schema = child_schema(root, *place.schema, step, is_index);
    if (!schema) break;
    std::size_t index = 0;
    if (is_index) std::from_chars(step.data(), step.data() + step.size(), index);
    if (is_index ? index >= place.value->size() : !place.value->contains(step)) break;
    place.value = is_index ? &(*place.value)[index] : &(*place.value)[step];
    place.schema = schema;
    place.name += is_index ? "[" + step + "]" : (place.name.empty() ? "" : ".") + step;
  }
  return place;
}

std::string number(const Json& json) { return fmt::format("{:.10g}", json.get<double>()); }

std::string range_of(const Json& schema, const char* unit) {
  std::string text;
  const auto add = [&](const char* key, const char* words) {
    if (schema.contains(key)) text += (text.empty() ? "" : " and ") + std::string(words) + number(schema[key]) + unit;
  };
  add("minimum", "at least ");
  add("exclusiveMinimum", "above ");
  add("maximum", "at most ");
  add("exclusiveMaximum", "below ");
  return text.empty() ? text : " " + text;
}

std::string names(const Json& list) {
  std::string text;
  for (const Json& entry : list)
    text += (text.empty() ? "" : ", ") + (entry.is_string() ? entry.get<std::string>() : entry.dump());
  return text;
}

std::string count_of(const Json& schema, const char* least, const char* most) {
  if (schema.contains(least) && schema.contains(most))
    return schema[least] == schema[most]
               ? fmt::format(" of {}", schema[least].get<int>())
               : fmt::format(" of {} to {}", schema[least].get<int>(), schema[most].get<int>());
  if (schema.contains(least)) return fmt::format(" of at least {}", schema[least].get<int>());
  return schema.contains(most) ? fmt::format(" of at most {}", schema[most].get<int>()) : "";
}

/// What the schema lets a value be: "a number above 0 and at most 10000".
std::string allowed_by(const Json& schema) {
  std::string about = schema.contains("description") ? schema["description"].get<std::string>() : "";
  if (schema.contains("anyOf") || schema.contains("oneOf")) return about;
  std::string kind;
  if (schema.contains("enum")) {
    kind = (schema["enum"].size() == 1 ? "" : "one of ") + names(schema["enum"]);
  } else {
    const std::string type = schema.value("type", "");
    if (type == "number") kind = "a number" + range_of(schema, "");
    else if (type == "integer") kind = "a whole number" + range_of(schema, "");
    else if (type == "boolean") kind = "true or false";
    else if (type == "string") kind = "a text that is not empty";
    else if (type == "array") kind = "a list" + count_of(schema, "minItems", "maxItems");
    else kind = "an object";
  }
  return kind + (about.empty() ? "" : ": " + about);
}

std::string problem_of_object(const JobPlace& place) {
  const std::string name = place.name.empty() ? "the job" : place.name;
  const Json& allowed = (*place.schema)["properties"];
  Json keys = Json::array();
  for (const auto& [key, ignored] : allowed.items()) keys.push_back(key);
  for (const auto& [key, ignored] : place.value->items())
    if (!allowed.contains(key))
      return fmt::format("{} has no key '{}'; its keys are {}", name, printable(key), names(keys));
  if (place.schema->contains("required"))
    for (const Json& key : (*place.schema)["required"])
      if (!place.value->contains(key.get<std::string>()))
        return fmt::format("{} lacks '{}', {}", name, key.get<std::string>(),
                           allowed_by(allowed[key.get<std::string>()]));
  return fmt::format("{} must be {}", name, allowed_by(*place.schema));
}

}  // namespace

std::string find_schema_problem(std::string_view text) {
  const auto violation = adapters::find_violation(job_schema(), text);
  if (!violation) return {};
  const Json root = Json::parse(job_schema());
  const Document document = Document::parse(text);
  const JobPlace place = place_of(root, document, violation->path);
  if (place.value->is_object() && place.schema->contains("properties")) return problem_of_object(place);
  const std::string value = printable(place.value->dump(-1, ' ', false, Document::error_handler_t::replace), 57);
  return fmt::format("{} is {} but must be {}", place.name.empty() ? "the job" : place.name, value,
                     allowed_by(*place.schema));
}

}  // namespace aplomb
