#include "aplomb/io/detail/readers.h"
namespace aplomb::detail {
Result<MeshFile> read_off(ReadContext& context) { return context.unusable("", "OFF is not read yet"); }
}  // namespace aplomb::detail
