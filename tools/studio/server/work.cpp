#include "server/work.h"

#include <nlohmann/json.hpp>

namespace aplomb::studio {

using Json = nlohmann::ordered_json;

std::string Work::profile_name() const {
  if (!profile) return {};
  return profile->name == model.name ? profile->name + ".profile" : profile->name;
}

std::string job_text(const Work& work, JobReader reader) {
  const std::string stem = work.model.stem();
  Json text{{"aplomb_job", 1}, {"model", work.model.name}};
  if (reader != JobReader::solver) text["output"] = stem + "-standing.3mf";
  if (reader == JobReader::run && work.profile) text["modifier"] = stem + "-dense.stl";
  if (work.profile) {
    const auto beside = work.profile->file().lexically_relative(work.model.folder);
    text["profile"] = reader == JobReader::solver ? beside.string() : work.profile_name();
  }
  text.update(Json::parse(work.job));
  return text.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aplomb::studio
