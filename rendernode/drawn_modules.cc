// Modules to the GPU.
#include "rendernode/drawn_modules.h"

#include "calibration/guard_band.h"
#include "rendernode/gl/memory.h"

namespace lfd {

Result<std::unique_ptr<const DrawnModules>> draw_modules(const DisplayCalibration& display,
                                                         const std::vector<std::uint32_t>& modules, int warp_level,
                                                         int guard_band_px) {
  if (const Status fits = check_guard_band(display.image, guard_band_px); !fits)
    return fits.error().within("ao.guard_band_px");
  auto drawn = std::make_unique<DrawnModules>();
  drawn->display = guard_band_px > 0 ? with_guard_band(display, guard_band_px) : display;
  drawn->tables = warp_tables(drawn->display, modules, warp_level);
  if (warp_level == 0) {  // a level that was asked for may be as coarse as it is
    LFD_TRY(drawn->warnings, warnings_of(drawn->tables, modules));
  }
  drawn->gpu = upload_modules(drawn->display, modules, drawn->tables, {guard_band_px, display.screen});
  LFD_TRY_STATUS(gl::memory_status("the tables of the modules' maps"));
  return std::unique_ptr<const DrawnModules>(std::move(drawn));
}

}  // namespace lfd
