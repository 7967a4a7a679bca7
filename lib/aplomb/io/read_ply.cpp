#include "aplomb/io/detail/readers.h"
namespace aplomb::detail {
Result<MeshFile> read_ply(ReadContext& context) { return context.unusable("", "PLY is not read yet"); }
}  // namespace aplomb::detail
