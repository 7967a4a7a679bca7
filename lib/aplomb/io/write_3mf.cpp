#include <zip.h>

#include <cstring>
#include <memory>
#include <set>

#include "aplomb/io/detail/writers.h"

namespace aplomb::detail {
namespace {

constexpr std::string_view kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";

/// The types of the package's parts, by extension; those of slicers are XML.
std::string content_types(const std::vector<PackagePart>& parts) {
  std::set<std::string> extensions;
  for (const PackagePart& part : parts) extensions.insert(part.path.substr(part.path.rfind('.') + 1));
  std::string types =
      R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>)";
  for (const std::string& extension : extensions)
    types += "<Default Extension=\"" + extension + "\" ContentType=\"text/xml\"/>";
  return types + "</Types>\n";
}

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

Result<std::string> model_xml(const TriangleMesh& mesh, const WriteOptions& options, const Job& job) {
  TextSink out;
  out.reserve(mesh.vertices.size() * 56 + mesh.triangles.size() * 44 + 1000);
  out.add(R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Application">Aplomb</metadata>
<resources><object id="1" type="model" name=")");
  out.add(escaped(options.name));
  out.add("\"><mesh>\n<vertices>\n");
  for (const Vec3& v : mesh.vertices) {
    out.add("<vertex x=\"");
    out.add(static_cast<float>(v.x));
    out.add("\" y=\"");
    out.add(static_cast<float>(v.y));
    out.add("\" z=\"");
    out.add(static_cast<float>(v.z));
    out.add("\"/>\n");
  }
  out.add("</vertices>\n<triangles>\n");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i % 65536 == 0 &&
        !job.report(0.3 * static_cast<double>(i) / static_cast<double>(mesh.triangles.size()), "write"))
      return cancelled();
    out.add("<triangle v1=\"");
    out.add(mesh.triangles[i][0]);
    out.add("\" v2=\"");
    out.add(mesh.triangles[i][1]);
    out.add("\" v3=\"");
    out.add(mesh.triangles[i][2]);
    out.add("\"/>\n");
  }
  out.add("</triangles>\n</mesh></object></resources>\n<build><item objectid=\"1\"/></build>\n</model>\n");
  return out.text();
}

/// A zip being written to memory.
class ZipWriter {
 public:
  ZipWriter() {
    zip_error_init(&error_);
    source_ = zip_source_buffer_create(nullptr, 0, 1, &error_);
    if (source_) zip_source_keep(source_);  // zip_close gives one reference away, the bytes are read through the other
    if (source_) archive_ = zip_open_from_source(source_, ZIP_TRUNCATE, &error_);
  }
  ~ZipWriter() {
    if (archive_) zip_discard(archive_);
    if (source_) zip_source_free(source_);
    zip_error_fini(&error_);
  }
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// `text` must live until finish().
  bool add(const char* name, std::string_view text) {
    if (!archive_) return false;
    zip_source_t* part = zip_source_buffer(archive_, text.data(), text.size(), 0);
    if (!part) return false;
    const zip_int64_t index = zip_file_add(archive_, name, part, ZIP_FL_ENC_UTF_8);
    if (index < 0) return zip_source_free(part), false;
    constexpr std::uint16_t kMidnight = 0, kFirstDay1980 = (1 << 5) | 1;  // no clock in the bytes
    const auto entry = static_cast<zip_uint64_t>(index);
    return zip_set_file_compression(archive_, entry, ZIP_CM_DEFLATE, 3) == 0 &&
           zip_file_set_dostime(archive_, entry, kMidnight, kFirstDay1980, 0) == 0;
  }

  Result<Bytes> finish(const Job& job) {
    if (!archive_) return failure();
    struct Progress {
      const Job& job;
      bool stop = false;
    } progress{job};
    zip_register_progress_callback_with_state(
        archive_, 0.02,
        [](zip_t*, double share, void* data) {
          auto& p = *static_cast<Progress*>(data);
          p.stop = p.stop || !p.job.report(0.3 + 0.7 * share, "write");
        },
        nullptr, &progress);
    zip_register_cancel_callback_with_state(
        archive_, [](zip_t*, void* data) { return static_cast<Progress*>(data)->stop ? 1 : 0; }, nullptr, &progress);
    if (zip_close(archive_) != 0) return progress.stop ? cancelled() : failure();
    archive_ = nullptr;
    if (progress.stop) return cancelled();  // at the very last report
    if (zip_source_open(source_) != 0) return failure();
    zip_stat_t status;
    zip_stat_init(&status);
    if (zip_source_stat(source_, &status) != 0 || !(status.valid & ZIP_STAT_SIZE)) return failure();
    Bytes bytes(status.size);
    const zip_int64_t got = zip_source_read(source_, bytes.data(), status.size);
    zip_source_close(source_);
    if (got < 0 || static_cast<zip_uint64_t>(got) != status.size) return failure();
    return bytes;
  }

  tl::unexpected<Error> failure() {
    const char* reason = archive_ ? zip_strerror(archive_) : zip_error_strerror(&error_);
    return fail(ErrorCode::third_party, std::string("cannot zip the 3MF: ") + reason);
  }

 private:
  zip_error_t error_;
  zip_source_t* source_ = nullptr;
  zip_t* archive_ = nullptr;
};

}  // namespace

Result<Bytes> encode_3mf(const TriangleMesh& mesh, const WriteOptions& options, const Job& job) {
  const Result<std::string> model = model_xml(mesh, options, job);
  if (!model) return tl::unexpected<Error>(model.error());
  const std::string types = content_types(options.parts);
  ZipWriter zip;
  bool is_added = zip.add("[Content_Types].xml", types) && zip.add("_rels/.rels", kRelationships) &&
                  zip.add("3D/3dmodel.model", *model);
  for (const PackagePart& part : options.parts) is_added = is_added && zip.add(part.path.c_str(), part.text);
  return is_added ? zip.finish(job) : zip.failure();
}

}  // namespace aplomb::detail
