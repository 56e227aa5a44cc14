/* Chordae in the hand of a haptic device: felt as they pull, dragged to a new length. */
#include "recorded_hand.h"

/* The chord with the largest tension, and that tension. */
static mvs_part tautest_chord(double *most) {
  mvs_part part = {0};
  mvs_view tension, id;
  uint32_t tautest = 0;
  const mvs_snapshot *snapshot = present();
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_TENSION, &tension));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_ID, &id));
  const double *const t = tension.data;
  for (uint32_t k = 1; k < tension.count; ++k) {
    if (t[k] > t[tautest]) tautest = k;
  }
  *most = t[tautest];
  part.id = ((const uint64_t *)id.data)[tautest];
  mvs_snapshot_release(snapshot);
  return part;
}

static void a_chord_is_felt_as_it_pulls(void) {
  mvs_device *device = opened("circle.txt", MVS_HAND_MODE_FEEL);
  double tension = 0;
  const mvs_part chord = tautest_chord(&tension);
  mvs_device_hand feel = {
      .struct_size = sizeof feel, .mode = MVS_HAND_MODE_FEEL, .chord = chord.id, .gain = 0.2};
  mvs_device_limits limits = {.struct_size = sizeof limits, .gate = 10};
  MUST(mvs_device_set_hand(device, &feel));
  MUST(mvs_device_set_limits(device, &limits));
  for (int k = 0; k < 200; ++k) turn(device);
  tautest_chord(&tension);
  CHECK(tension > 0.05);
  /* the valve is at rest; the recorded circle continues, with small damping */
  CHECK(fabs(length(state_of(device).force) - 0.2 * tension) < 0.02 * tension);
  mvs_device_close(device);
}

static void a_chord_is_dragged_to_a_new_length(void) {
  mvs_device *device = opened("grasp_a2.txt", MVS_HAND_MODE_DRAG);
  double tension = 0;
  const mvs_part chord = tautest_chord(&tension);
  mvs_device_hand drag = {
      .struct_size = sizeof drag, .mode = MVS_HAND_MODE_DRAG, .chord = chord.id};
  MUST(mvs_device_set_hand(device, &drag));
  turn_until(device, MVS_EVENT_GRASPED, 400);
  const mvs_device_report report = turn_until(device, MVS_EVENT_DRAGGED, 500);
  mvs_op_chord_length op = {.op = {sizeof op, MVS_OP_CHORD_LENGTH}, .chord = chord.id};
  memcpy(op.drag_to.at, report.drag_to, sizeof report.drag_to);
  op.drag_to.given = 1;
  MUST(mvs_apply_op(sim, &op.op, NULL));
  mvs_device_close(device);
}

int main(void) {
  close_the_valve();
  a_chord_is_felt_as_it_pulls();
  a_chord_is_dragged_to_a_new_length();
  return finish_devices("device_chords");
}
