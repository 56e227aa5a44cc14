// Function table of Force Dimension's DHD and DRD, declared here so that the vendor's headers are
// not needed. Units are SI; the device number is the last argument.
#pragma once
#include <string>

namespace forcedimension {

// Return codes; a negative value is a failure, explained by error_get_last.
inline constexpr int kTimeGuard = 1;       // success, with the previous sample
inline constexpr int kMotorSaturated = 2;  // success, with saturated motors

enum Error {
  kErrorCom = 2,
  kErrorBusy = 3,
  kErrorNoDriver = 4,
  kErrorNoDevice = 5,
  kErrorTimeout = 7,
  kErrorNotReady = 12,
  kErrorInUse = 20
};

// Indices into the array of get_status.
inline constexpr int kStatusCount = 17;
enum Status {
  kPower = 0,
  kConnected = 1,
  kReset = 3,  // not calibrated
  kForce = 5,  // motors are on
  kErrorSeen = 9,
  kForceOffCause = 14
};
enum ForceOff {
  kOffByButton = 1,
  kOffByVelocity = 2,
  kOffByWatchdog = 3,
  kOffBySoftware = 4,
  kOffByUsb = 5,
  kOffByDeadMan = 6
};

enum Type {
  kOmega3 = 33,
  kOmega6Right = 34,
  kOmega7Right = 35,
  kOmega6Left = 36,
  kOmega7Left = 37,
  kFalcon = 60,
  kDelta3 = 63,
  kSigma7Right = 104,
  kSigma7Left = 105,
  kLambda7Right = 108,
  kLambda7Left = 109,
  kLambda3 = 203,
  kSigma3 = 206
};

#if defined(_WIN32) && !defined(_WIN64)
#define MVS_DHD __stdcall
#else
#define MVS_DHD
#endif

struct Dhd {
  int(MVS_DHD *get_device_count)();
  int(MVS_DHD *open_id)(char);
  int(MVS_DHD *close)(char);
  int(MVS_DHD *get_system_type)(char);
  const char *(MVS_DHD *get_system_name)(char);
  int(MVS_DHD *get_serial_number)(unsigned short *, char);
  int(MVS_DHD *get_version)(double *, char);
  bool(MVS_DHD *has_wrist)(char);
  bool(MVS_DHD *has_active_wrist)(char);
  bool(MVS_DHD *has_gripper)(char);
  bool(MVS_DHD *has_active_gripper)(char);
  bool(MVS_DHD *is_left_handed)(char);
  int(MVS_DHD *get_status)(int *, char);
  int(MVS_DHD *get_position)(double *, double *, double *, char);
  int(MVS_DHD *get_pose)(double *, double *, double *, double *, char);
  int(MVS_DHD *get_velocity)(double *, double *, double *, char);
  int(MVS_DHD *get_gripper_angle)(double *, char);
  int(MVS_DHD *get_gripper_gap)(double *, char);
  unsigned(MVS_DHD *get_button_mask)(char);
  int(MVS_DHD *enable_force)(unsigned char, char);
  int(MVS_DHD *set_force)(double, double, double, double, double, double, double, char);
  int(MVS_DHD *stop)(char);
  int(MVS_DHD *set_max_force)(double, char);
  int(MVS_DHD *error_get_last)();
  const char *(MVS_DHD *error_get_last_str)();
  // DRD, with automatic calibration; null if only DHD was found
  int(MVS_DHD *drd_open_id)(char);
  int(MVS_DHD *drd_close)(char);
  bool(MVS_DHD *drd_is_supported)(char);
  bool(MVS_DHD *drd_is_initialized)(char);
  int(MVS_DHD *drd_auto_init)(char);
  int(MVS_DHD *drd_stop)(bool, char);

  bool has_drd() const {
    return drd_open_id && drd_close && drd_is_supported && drd_is_initialized && drd_auto_init &&
           drd_stop;
  }
};

// Looks up the functions in a loaded library; returns the missing names, except those of DRD.
std::string bind(void *library, Dhd &dhd);

}  // namespace forcedimension
