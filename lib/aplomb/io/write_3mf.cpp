#include <zip.h>

#include <cstring>
#include <memory>
#include <set>

#include "aplomb/io/detail/threemf_model.h"
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
          p.stop = p.stop || !p.job.report(share, "write");
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
  const Result<ModelParts> made = model_parts(mesh, options, job.part(0, 0.3));
  if (!made) return tl::unexpected<Error>(made.error());
  std::vector<PackagePart> parts = options.parts;
  if (made->settings) parts.push_back(*made->settings);
  const std::string types = content_types(parts);
  ZipWriter zip;
  bool is_added = zip.add("[Content_Types].xml", types) && zip.add("_rels/.rels", kRelationships) &&
                  zip.add("3D/3dmodel.model", made->model_xml);
  for (const PackagePart& part : parts) is_added = is_added && zip.add(part.path.c_str(), part.text);
  return is_added ? zip.finish(job.part(0.3, 1)) : zip.failure();
}

}  // namespace aplomb::detail
