// Chooses the decoder by the first bytes.
#include "proto/pictures/decode.h"

#include "proto/pictures/jpeg.h"
#include "proto/pictures/png.h"

namespace lfd {

Result<Picture8> decode_picture(std::string_view file) {
  if (file.starts_with("\x89PNG")) return decode_png(file);
  if (file.starts_with("\xff\xd8\xff")) return decode_jpeg(file);
  return Error("neither PNG nor JPEG");
}

}  // namespace lfd
