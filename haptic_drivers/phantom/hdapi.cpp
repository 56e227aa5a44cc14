// Symbol lookup of HDAPI, and its error stack.
#include "hdapi.h"

#include "common/library.h"
#include "common/sentence.h"

namespace phantom {

std::string bind(void *library, Hdapi &hd) {
  std::string missing;
  const auto take = [&](const char *name, auto &function) {
    driver::bind(library, name, function, missing);
  };
  take("hdInitDevice", hd.init_device);
  take("hdDisableDevice", hd.disable_device);
  take("hdMakeCurrentDevice", hd.make_current);
  take("hdBeginFrame", hd.begin_frame);
  take("hdEndFrame", hd.end_frame);
  take("hdGetError", hd.get_error);
  take("hdGetErrorString", hd.error_string);
  take("hdEnable", hd.enable);
  take("hdDisable", hd.disable);
  take("hdIsEnabled", hd.is_enabled);
  take("hdGetBooleanv", hd.get_booleans);
  take("hdGetIntegerv", hd.get_integers);
  take("hdGetDoublev", hd.get_doubles);
  take("hdGetString", hd.get_string);
  take("hdSetDoublev", hd.set_doubles);
  take("hdCheckCalibration", hd.check_calibration);
  take("hdUpdateCalibration", hd.update_calibration);
  take("hdStartScheduler", hd.start_scheduler);
  take("hdStopScheduler", hd.stop_scheduler);
  take("hdSetSchedulerRate", hd.set_scheduler_rate);
  take("hdScheduleAsynchronous", hd.schedule);
  take("hdUnschedule", hd.unschedule);
  return missing;
}

// The loop is bounded, in case a library never reports an empty stack.
ErrorInfo take_errors(const Hdapi &hd) {
  ErrorInfo newest = {};
  for (int i = 0; i < 64; ++i) {
    const ErrorInfo error = hd.get_error();
    if (error.code == 0) break;
    if (i == 0) newest = error;
  }
  return newest;
}

std::string describe(const Hdapi &hd, unsigned code) {
  const char *const words = hd.error_string(code);
  return driver::sentence("%s (0x%03x)", words ? words : "error", code);
}

}  // namespace phantom
