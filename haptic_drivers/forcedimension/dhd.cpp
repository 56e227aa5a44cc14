// Symbol lookup of DHD and DRD.
#include "dhd.h"

#include "common/library.h"

namespace forcedimension {

std::string bind(void *library, Dhd &dhd) {
  std::string missing, optional;
  const auto take = [&](const char *name, auto &function) {
    driver::bind(library, name, function, missing);
  };
  take("dhdGetDeviceCount", dhd.get_device_count);
  take("dhdOpenID", dhd.open_id);
  take("dhdClose", dhd.close);
  take("dhdGetSystemType", dhd.get_system_type);
  take("dhdGetSystemName", dhd.get_system_name);
  take("dhdGetSerialNumber", dhd.get_serial_number);
  take("dhdGetVersion", dhd.get_version);
  take("dhdHasWrist", dhd.has_wrist);
  take("dhdHasActiveWrist", dhd.has_active_wrist);
  take("dhdHasGripper", dhd.has_gripper);
  take("dhdHasActiveGripper", dhd.has_active_gripper);
  take("dhdIsLeftHanded", dhd.is_left_handed);
  take("dhdGetStatus", dhd.get_status);
  take("dhdGetPosition", dhd.get_position);
  take("dhdGetPositionAndOrientationFrame", dhd.get_pose);
  take("dhdGetLinearVelocity", dhd.get_velocity);
  take("dhdGetGripperAngleRad", dhd.get_gripper_angle);
  take("dhdGetGripperGap", dhd.get_gripper_gap);
  take("dhdGetButtonMask", dhd.get_button_mask);
  take("dhdEnableForce", dhd.enable_force);
  take("dhdSetForceAndTorqueAndGripperForce", dhd.set_force);
  take("dhdStop", dhd.stop);
  take("dhdSetMaxForce", dhd.set_max_force);
  take("dhdErrorGetLast", dhd.error_get_last);
  take("dhdErrorGetLastStr", dhd.error_get_last_str);
  driver::bind(library, "drdOpenID", dhd.drd_open_id, optional);
  driver::bind(library, "drdClose", dhd.drd_close, optional);
  driver::bind(library, "drdIsSupported", dhd.drd_is_supported, optional);
  driver::bind(library, "drdIsInitialized", dhd.drd_is_initialized, optional);
  driver::bind(library, "drdAutoInit", dhd.drd_auto_init, optional);
  driver::bind(library, "drdStop", dhd.drd_stop, optional);
  return missing;
}

}  // namespace forcedimension
