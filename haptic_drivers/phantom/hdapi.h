// Function table of OpenHaptics' HDAPI, declared here so that the vendor's headers are not needed;
// names, types and numbers are those of its public reference guide.
#pragma once
#include <string>

namespace phantom {

inline constexpr unsigned kInvalidHandle = 0xFFFFFFFFu;
inline constexpr unsigned kCallbackDone = 0, kCallbackContinue = 1;
inline constexpr unsigned short kHighestPriority = 65535;

// The result of hdGetError, returned by value: twelve bytes.
struct ErrorInfo {
  unsigned code;
  int internal;
  unsigned device;
};
static_assert(sizeof(ErrorInfo) == 12, "as the library returns it");

enum Error : unsigned {
  kInvalidOperation = 0x102,
  kBadHandle = 0x104,
  kWarmMotors = 0x200,
  kExceededForce = 0x201,
  kExceededImpulse = 0x202,
  kExceededVelocity = 0x203,
  kForceError = 0x204,
  kDeviceFault = 0x300,
  kAlreadyInitiated = 0x301,
  kCommError = 0x302,
  kCommConfigError = 0x303,
  kTimerError = 0x304,
  kInvalidLicence = 0x600
};
// Error classes: bits 8 to 11 of the code.
enum ErrorClass : unsigned { kWarnings = 0x200, kDeviceErrors = 0x300 };

enum Parameter : unsigned {
  kButtons = 0x2000,
  kInkwell = 0x2002,
  kPosition = 0x2050,   // mm
  kVelocity = 0x2051,   // mm/s
  kTransform = 0x2052,  // 16, by columns, mm
  kModel = 0x2501,
  kSerial = 0x2504,
  kFirmware = 0x2505,
  kUsableWorkspace = 0x2551,  // two corners, mm
  kInputFreedoms = 0x2553,
  kOutputFreedoms = 0x2554,
  kCalibrationStyle = 0x2555,
  kUpdateRate = 0x2600,        // Hz
  kMaxStiffness = 0x2602,      // N/mm
  kMaxForce = 0x2603,          // N
  kContinuousForce = 0x2604,   // N
  kMotorTemperature = 0x2605,  // of each motor, 0 to 1
  kVelocityLimit = 0x2606,     // mm/s
  kMaxDamping = 0x2609,        // N s/mm
  kMaxTorque = 0x2622,         // mN m
  kForce = 0x2700,             // N
  kTorque = 0x2701             // mN m
};
enum Capability : unsigned {
  kForceOutput = 0x4000,
  kForceClamping = 0x4001,
  kForceRamping = 0x4002,
  kSoftwareForceLimit = 0x4003
};
enum Calibration : unsigned { kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kNeedsHand = 0x5002 };
enum CalibrationStyle : unsigned { kEncoderReset = 1, kAutomatic = 2, kInInkwell = 4 };

#if defined(_WIN32) && !defined(_WIN64)
#define MVS_HDAPI __stdcall
#else
#define MVS_HDAPI
#endif

using Callback = unsigned(MVS_HDAPI *)(void *);

struct Hdapi {
  unsigned(MVS_HDAPI *init_device)(const char *);
  void(MVS_HDAPI *disable_device)(unsigned);
  void(MVS_HDAPI *make_current)(unsigned);
  void(MVS_HDAPI *begin_frame)(unsigned);
  void(MVS_HDAPI *end_frame)(unsigned);
  ErrorInfo(MVS_HDAPI *get_error)();
  const char *(MVS_HDAPI *error_string)(unsigned);
  void(MVS_HDAPI *enable)(unsigned);
  void(MVS_HDAPI *disable)(unsigned);
  unsigned char(MVS_HDAPI *is_enabled)(unsigned);
  void(MVS_HDAPI *get_booleans)(unsigned, unsigned char *);
  void(MVS_HDAPI *get_integers)(unsigned, int *);
  void(MVS_HDAPI *get_doubles)(unsigned, double *);
  const char *(MVS_HDAPI *get_string)(unsigned);
  void(MVS_HDAPI *set_doubles)(unsigned, const double *);
  unsigned(MVS_HDAPI *check_calibration)();
  void(MVS_HDAPI *update_calibration)(unsigned);
  void(MVS_HDAPI *start_scheduler)();
  void(MVS_HDAPI *stop_scheduler)();
  void(MVS_HDAPI *set_scheduler_rate)(unsigned long);
  unsigned long(MVS_HDAPI *schedule)(Callback, void *, unsigned short);
  void(MVS_HDAPI *unschedule)(unsigned long);
};

// Looks up the functions in a loaded library; returns the missing names.
std::string bind(void *library, Hdapi &hd);

// Empties the error stack of the library and returns the newest error; code 0 without an error.
ErrorInfo take_errors(const Hdapi &hd);

// Returns "HD_COMM_ERROR (0x302)", with the library's text if it has one.
std::string describe(const Hdapi &hd, unsigned code);

}  // namespace phantom
