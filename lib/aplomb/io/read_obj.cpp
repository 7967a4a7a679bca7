#include "aplomb/io/detail/polygon.h"
#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/text_cursor.h"

namespace aplomb::detail {
namespace {

class ObjReader {
 public:
  explicit ObjReader(ReadContext& context)
      : context_(context), text_(context.text()), mesh_(context), cutter_(mesh_, context) {}

  Result<MeshFile> read() {
    for (std::size_t lines = 0; !text_.at_end(); ++lines, text_.next_line()) {
      if (lines % 65536 == 0 && !context_.proceed(text_.share_read())) return cancelled();
      if (text_.at_line_end()) continue;
      Result<void> done;
      const std::string_view keyword = text_.word();
      if (keyword == "v") done = read_vertex();
      else if (keyword == "f" || keyword == "fo") done = read_face();
      else if (keyword == "o" && ++names_ == 1) name_ = text_.rest_of_line();
      else if (keyword == "curv" || keyword == "surf" || keyword == "cstype")
        context_.note("free-form curves and surfaces were ignored");
      if (!done) return tl::unexpected<Error>(done.error());
    }
    return single_object("OBJ", names_ == 1 ? short_name(name_) : "", mesh_.take());
  }

 private:
  Result<void> read_vertex() {
    const Result<Vec3> position = context_.read_position(text_);
    if (!position) return tl::unexpected(position.error());
    if (!mesh_.add_vertex(*position)) return mesh_.failure();
    return {};  // a weight or a colour may follow
  }

  Result<void> read_face() {
    corners_.clear();
    while (!text_.at_line_end()) {
      if (auto admitted = context_.admit_corner(corners_.size()); !admitted) return admitted;
      const auto index = text_.integer();
      if (!index)
        return context_.unusable(text_.place(), "expected a vertex index, found " + in_quotes(text_.peek_word()) +
                                                    "; export the model again");
      text_.skip_word();  // the texture's and the normal's index
      const auto count = static_cast<long long>(mesh_.mesh().vertices.size());
      const long long corner = *index > 0 ? *index - 1 : *index < 0 && *index >= -count ? count + *index : -1;
      if (corner < 0 || corner >= count) return out_of_range(*index);
      corners_.push_back(static_cast<std::uint32_t>(corner));
    }
    if (corners_.size() < 3) {
      context_.note("faces with fewer than three corners were ignored");
      return {};
    }
    return cutter_.add(corners_);
  }

  tl::unexpected<Error> out_of_range(long long index) const {
    return context_.unusable(text_.place(), "vertex index " + std::to_string(index) +
                                                " is out of range, the file has " +
                                                std::to_string(mesh_.mesh().vertices.size()) +
                                                " vertices up to here; export the model again");
  }

  ReadContext& context_;
  TextCursor text_;
  GrowingMesh mesh_;
  PolygonCutter cutter_;
  std::vector<std::uint32_t> corners_;
  std::string_view name_;
  int names_ = 0;
};

}  // namespace

Result<MeshFile> read_obj(ReadContext& context) { return ObjReader(context).read(); }

}  // namespace aplomb::detail
