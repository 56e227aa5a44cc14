// The part of Force Dimension's DHD and DRD that this driver calls, declared here so that the
// vendor's headers need not be there. Units are SI; a function of a device takes its number last.
#pragma once
#include <string>

namespace forcedimension {

// What a function returns; below zero: it failed, and error_get_last says why.
inline constexpr int kTimeGuard = 1;       // done, but the sample is the one before
inline constexpr int kMotorSaturated = 2;  // done, but the motors could not give all of it

enum Error {
  kErrorCom = 2,
  kErrorBusy = 3,
  kErrorNoDriver = 4,
  kErrorNoDevice = 5,
  kErrorTimeout = 7,
  kErrorNotReady = 12,
  kErrorInUse = 20
};

// Places in what get_status fills.
inline constexpr int kStatusCount = 17;
enum Status {
  kPower = 0,
  kConnected = 1,
  kReset = 3,  // it waits to be calibrated
  kForce = 5,  // the motors follow
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
  // DRD, which calibrates by itself; null if only DHD was found
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

// Looks the functions up in a loaded library; the names of those that it does not export, but for
// DRD's.
std::string bind(void *library, Dhd &dhd);

}  // namespace forcedimension
