#include "aplomb/io/detail/readers.h"
namespace aplomb::detail {
Result<MeshFile> read_3mf(ReadContext& context) { return context.unusable("", "3MF is not read yet"); }
}  // namespace aplomb::detail
