#include "aplomb/io/detail/threemf_model.h"

#include <fmt/format.h>

#include "aplomb/io/detail/writers.h"

namespace aplomb::detail {
namespace {

/// Text as an XML attribute's value; what XML cannot hold becomes a blank.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '"') out += "&quot;";
    else out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out;
}

std::string percent(double ratio) { return fmt::format("{:.6g}%", 100 * ratio); }

constexpr std::string_view ballast_name = "ballast";

/// Builds the model part, object by object.
class ModelXml {
 public:
  ModelXml(const Job& job, std::size_t triangles) : job_(job), all_(static_cast<double>(triangles)) {
    out_.reserve(triangles * 72 + 2000);
    out_.add(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
        "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"");
  }

  void begin(std::string_view name_spaces, std::string_view application, std::string_view metadata = {}) {
    out_.add(name_spaces);
    out_.add(">\n<metadata name=\"Application\">");
    out_.add(application);
    out_.add("</metadata>\n");
    out_.add(metadata);
    out_.add("<resources>");
  }

  /// False when cancelled.
  bool add_object(std::uint32_t id, std::string_view name, const TriangleMesh& mesh, std::string_view metadata = {}) {
    begin_object(id, name);
    out_.add(metadata);
    out_.add("<mesh>\n<vertices>\n");
    for (const Vec3& v : mesh.vertices) {
      out_.add("<vertex x=\"");
      out_.add(static_cast<float>(v.x));
      out_.add("\" y=\"");
      out_.add(static_cast<float>(v.y));
      out_.add("\" z=\"");
      out_.add(static_cast<float>(v.z));
      out_.add("\"/>\n");
    }
    out_.add("</vertices>\n<triangles>\n");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (i % 65536 == 0 && !job_.report(static_cast<double>(i) / all_, "write")) return false;
      out_.add("<triangle v1=\"");
      out_.add(mesh.triangles[i][0]);
      out_.add("\" v2=\"");
      out_.add(mesh.triangles[i][1]);
      out_.add("\" v3=\"");
      out_.add(mesh.triangles[i][2]);
      out_.add("\"/>\n");
    }
    out_.add("</triangles>\n</mesh></object>");
    return true;
  }

  /// Of objects 1 and 2.
  void add_pair(std::uint32_t id, std::string_view name) {
    begin_object(id, name);
    out_.add("<components><component objectid=\"1\"/><component objectid=\"2\"/></components></object>");
  }

  std::string finish(std::uint32_t id) {
    out_.add("</resources>\n<build><item objectid=\"");
    out_.add(id);
    out_.add("\"/></build>\n</model>\n");
    return out_.text();
  }

 private:
  void begin_object(std::uint32_t id, std::string_view name) {
    out_.add("<object id=\"");
    out_.add(id);
    out_.add("\" type=\"model\" name=\"");
    out_.add(escaped(name));
    out_.add("\">");
  }

  const Job& job_;
  double all_;
  TextSink out_;
};

/// PrusaSlicer: one mesh of both, and its ranges of triangles.
PackagePart prusaslicer_settings(std::size_t model_triangles, const WriteOptions& options) {
  const InfillModifier& modifier = *options.modifier;
  const std::size_t all = model_triangles + modifier.volume.triangles.size();
  const auto said = [](std::string_view type, std::string_view key, std::string_view value) {
    return fmt::format(R"(<metadata type="{}" key="{}" value="{}"/>)", type, key, escaped(value)) + "\n";
  };
  const auto filled = [&said](std::string_view type, double ratio) {  // only rectilinear infill may be solid
    return said(type, "fill_density", percent(ratio)) + (ratio >= 1 ? said(type, "fill_pattern", "rectilinear") : "");
  };
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n<object id=\"1\" instances_count=\"1\">\n";
  xml += said("object", "name", options.name);
  if (modifier.rest_ratio) xml += filled("object", *modifier.rest_ratio);
  xml += fmt::format("<volume firstid=\"0\" lastid=\"{}\">\n", model_triangles - 1) +
         said("volume", "name", options.name) + said("volume", "volume_type", "ModelPart") + "</volume>\n";
  xml += fmt::format("<volume firstid=\"{}\" lastid=\"{}\">\n", model_triangles, all - 1) +
         said("volume", "name", ballast_name) + said("volume", "modifier", "1") +
         said("volume", "volume_type", "ParameterModifier") + filled("volume", modifier.infill_ratio) + "</volume>\n";
  return {"Metadata/Slic3r_PE_model.config", xml + "</object>\n</config>\n"};
}

/// Bambu Studio and OrcaSlicer: an object of two parts.
PackagePart orca_settings(const WriteOptions& options) {
  const InfillModifier& modifier = *options.modifier;
  const auto said = [](std::string_view key, std::string_view value) {
    return fmt::format(R"(<metadata key="{}" value="{}"/>)", key, escaped(value)) + "\n";
  };
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n<object id=\"3\">\n" + said("name", options.name);
  if (modifier.rest_ratio) xml += said("sparse_infill_density", percent(*modifier.rest_ratio));
  xml += "<part id=\"1\" subtype=\"normal_part\">\n" + said("name", options.name) + "</part>\n";
  xml += "<part id=\"2\" subtype=\"modifier_part\">\n" + said("name", ballast_name) +
         said("sparse_infill_density", percent(modifier.infill_ratio)) +
         (modifier.infill_ratio >= 1 ? said("sparse_infill_pattern", "zig-zag") : "") + "</part>\n";
  return {"Metadata/model_settings.config", xml + "</object>\n</config>\n"};
}

/// Cura's settings of one object.
std::string cura_settings(const std::vector<std::pair<std::string_view, std::string>>& settings) {
  std::string xml = "<metadatagroup>";
  for (const auto& [key, value] : settings)
    xml += fmt::format(R"(<metadata name="cura:{}" type="xs:string" preserve="true">{}</metadata>)", key, value);
  return xml + "</metadatagroup>";
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// An infill mesh has no walls and no skins of its own.
std::string cura_modifier(const InfillModifier& modifier) {
  return cura_settings({{"infill_mesh", "True"},
                        {"infill_sparse_density", number(100 * modifier.infill_ratio)},
                        {"wall_line_count", "0"},
                        {"top_layers", "0"},
                        {"bottom_layers", "0"}});
}

Result<ModelParts> with_modifier(const TriangleMesh& mesh, const WriteOptions& options, const Job& job) {
  const InfillModifier& modifier = *options.modifier;
  ModelXml xml(job, mesh.triangles.size() + modifier.volume.triangles.size());
  if (modifier.flavor == Flavor::prusaslicer) {
    xml.begin({}, "Aplomb");
    if (!xml.add_object(1, options.name, joined(mesh, modifier.volume))) return cancelled();
    return ModelParts{xml.finish(1), prusaslicer_settings(mesh.triangles.size(), options)};
  }
  const bool is_cura = modifier.flavor == Flavor::cura;
  if (is_cura) xml.begin(R"( xmlns:cura="http://software.ultimaker.com/xml/cura/3mf/2015/10")", "Aplomb");
  else  // they read settings only of what calls itself theirs
    xml.begin(R"( xmlns:BambuStudio="http://schemas.bambulab.com/package/2021")", "BambuStudio-02.00.00.00",
              "<metadata name=\"BambuStudio:3mfVersion\">1</metadata>\n");
  const std::string rest = is_cura && modifier.rest_ratio
                               ? cura_settings({{"infill_sparse_density", number(100 * *modifier.rest_ratio)}})
                               : std::string();
  if (!xml.add_object(1, options.name, mesh, rest) ||
      !xml.add_object(2, ballast_name, modifier.volume, is_cura ? cura_modifier(modifier) : std::string()))
    return cancelled();
  xml.add_pair(3, options.name);
  ModelParts made{xml.finish(3), std::nullopt};
  if (!is_cura) made.settings = orca_settings(options);
  return made;
}

}  // namespace

Result<ModelParts> model_parts(const TriangleMesh& mesh, const WriteOptions& options, const Job& job) {
  if (options.modifier) return with_modifier(mesh, options, job);
  ModelXml xml(job, mesh.triangles.size());
  xml.begin({}, "Aplomb");
  if (!xml.add_object(1, options.name, mesh)) return cancelled();
  return ModelParts{xml.finish(1), std::nullopt};
}

}  // namespace aplomb::detail
