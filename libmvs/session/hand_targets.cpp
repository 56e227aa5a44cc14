// A mutex-protected list of posted hands.
#include "session/hand_targets.h"

#include "session/recorded_event.h"

namespace mvs::core {
namespace {

bool same_hand(const Tool &a, const Tool &b) {
  return a.position == b.position && a.axis == b.axis;
}

// Returns null if the state lacks the tool.
const Tool *tool_in(const State &state, Id id) {
  for (const Tool &tool : state.tools.get()) {
    if (tool.id == id) return &tool;
  }
  return nullptr;
}

}  // namespace

void HandTargets::post(const Tool &hand, bool has_axis) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Tool &posted : posted_) {
    if (posted.id != hand.id) continue;
    posted.position = hand.position;
    if (has_axis) posted.axis = hand.axis;
    return;
  }
  posted_.push_back(hand);
}

std::vector<RecordedEvent> HandTargets::take(State &state) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<RecordedEvent> taken;
  for (const Tool &hand : posted_) {
    const Tool *const tool = tool_in(state, hand.id);
    if (!tool || same_hand(*tool, hand)) continue;
    move_tool(state, hand.id, hand.position, hand.axis);
    taken.push_back(event_of(RecordedEvent::tool_move, hand));
  }
  return taken;
}

void HandTargets::done(const State &state) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::erase_if(posted_, [&](const Tool &hand) {
    const Tool *const tool = tool_in(state, hand.id);
    return !tool || same_hand(*tool, hand);
  });
}

void HandTargets::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  posted_.clear();
}

}  // namespace mvs::core
