// Tool trajectories: construction, run-length append, replay of a row.
#include "history/tool_trajectory.h"

#include <algorithm>

namespace mvs::core {
namespace {

// Rows per run. A snapshot shares the last run, so that the next append copies it: runs stay short.
// The fixed size of an event is small beside this many rows.
constexpr size_t most_rows = 128;

bool is_stepped_alike(const RecordedEvent &a, const RecordedEvent &b) {
  return a.solver == b.solver && a.dt == b.dt && a.damping == b.damping && a.budget == b.budget &&
         a.max_iterations == b.max_iterations && a.residual == b.residual;
}

// The column of a tool in the rows of a trajectory; the width of a row if it lacks the tool.
size_t column_of(const RecordedEvent &trajectory, Id tool) {
  size_t column = 0;
  for (const Tool &has : trajectory.tools.get()) {
    if (has.id == tool) break;
    column += points_of_tool(has);
  }
  return column;
}

bool has_tool(const RecordedEvent &trajectory, Id tool) {
  const std::vector<Tool> &tools = trajectory.tools;
  return std::any_of(tools.begin(), tools.end(), [&](const Tool &t) { return t.id == tool; });
}

bool has_tools_of(const RecordedEvent &trajectory, const RecordedEvent &more) {
  const std::vector<Tool> &tools = more.tools;
  return std::all_of(tools.begin(), tools.end(),
                     [&](const Tool &t) { return has_tool(trajectory, t.id); });
}

// Reserves room for `more` items by doubling, up to the size of a whole run.
template <typename Item>
std::vector<Item> &with_room(CowVector<Item> &items, size_t more, size_t most) {
  std::vector<Item> &all = items.edit();
  const size_t needed = all.size() + more;
  if (all.capacity() < needed) all.reserve(std::max(needed, std::min(2 * needed, most)));
  return all;
}

// Appends one row of `from` to `run`; tools that `from` lacks keep their points of the last row.
void add_row(RecordedEvent &run, const RecordedEvent &from, size_t row) {
  const size_t width = points_per_row(run);
  std::vector<Vec3> &points = with_room(run.points, width, most_rows * width);
  with_room(run.steps_per_row, 1, most_rows).push_back(from.steps_per_row.get()[row]);
  const Vec3 *const rows = from.points.get().data() + row * points_per_row(from);
  for (const Tool &tool : run.tools.get()) {
    const bool is_there = has_tool(from, tool.id);
    const size_t column = column_of(from, tool.id);
    for (size_t k = 0; k < points_of_tool(tool); ++k) {
      points.push_back(is_there ? rows[column + k] : points[points.size() - width]);
    }
  }
  run.count += from.steps_per_row.get()[row];
}

template <typename Item>
void drop_front(std::vector<Item> &items, size_t count) {
  items.erase(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(count));
}

void take_rows(RecordedEvent &run, RecordedEvent &more) {
  const size_t room = most_rows - std::min(most_rows, run.steps_per_row.size());
  const size_t rows = std::min(room, more.steps_per_row.size()), width = points_per_row(more);
  if (rows == 0 || !has_tools_of(run, more)) return;
  std::vector<Vec3> &left = more.points.edit();
  std::vector<uint32_t> &steps = more.steps_per_row.edit();
  RecordedEvent longer = run;
  for (size_t row = 0; row < rows; ++row) {
    add_row(rows == 1 ? run : longer, more, row);
    more.count -= steps[row];
  }
  if (rows > 1) run = std::move(longer);
  drop_front(left, rows * width);
  drop_front(steps, rows);
}

void take_steps(uint64_t &count, uint64_t &from, uint64_t most) {
  const uint64_t taken = std::min(from, most - std::min(most, count));
  count += taken;
  from -= taken;
}

}  // namespace

size_t points_of_tool(const Tool &tool) {
  return tool.kind == ToolKind::rod || tool.kind == ToolKind::convex ? 2 : 1;
}

size_t points_per_row(const RecordedEvent &trajectory) {
  size_t points = 0;
  for (const Tool &tool : trajectory.tools.get()) points += points_of_tool(tool);
  return points;
}

RecordedEvent trajectory_event(const std::vector<RecordedEvent> &hands, const RecordedEvent &step) {
  RecordedEvent trajectory = step;
  trajectory.kind = RecordedEvent::tool_trajectory;
  std::vector<Tool> tools;
  std::vector<Vec3> points;
  for (const RecordedEvent &hand : hands) {
    const Tool &moved = hand.tools.get()[0];
    Tool tool;
    tool.id = moved.id;
    tool.kind = moved.kind;
    tools.push_back(tool);
    points.push_back(moved.position);
    if (points_of_tool(moved) == 2) points.push_back(moved.axis);
  }
  trajectory.tools = std::move(tools);
  trajectory.points = std::move(points);
  trajectory.steps_per_row = {static_cast<uint32_t>(step.count)};
  return trajectory;
}

void append_steps(RecordedEvent &run, RecordedEvent &more) {
  if (!is_stepped_alike(run, more)) return;
  if (run.kind == RecordedEvent::step && more.kind == RecordedEvent::step) {
    take_steps(run.count, more.count, RecordedEvent::most_count);
  } else if (run.kind == RecordedEvent::tool_trajectory &&
             more.kind == RecordedEvent::tool_trajectory) {
    take_rows(run, more);
  } else if (run.kind == RecordedEvent::tool_trajectory && more.kind == RecordedEvent::step) {
    uint64_t last = run.steps_per_row.get().back();
    const uint64_t before = last;
    std::vector<uint32_t> &steps = run.steps_per_row.edit();
    take_steps(last, more.count, UINT32_MAX);
    steps.back() = static_cast<uint32_t>(last);
    run.count += last - before;
  }
}

RecordedEvent with_tools_of(const RecordedEvent &last, RecordedEvent trajectory) {
  const bool continues = last.kind == RecordedEvent::tool_trajectory &&
                         trajectory.kind == RecordedEvent::tool_trajectory &&
                         is_stepped_alike(last, trajectory) &&
                         last.steps_per_row.size() < most_rows;
  if (!continues) return trajectory;
  RecordedEvent wide = last;
  const size_t width = points_per_row(last), columns = points_per_row(trajectory);
  std::vector<Vec3> held(last.points.end() - static_cast<std::ptrdiff_t>(width), last.points.end());
  for (const Tool &tool : trajectory.tools.get()) {
    if (has_tool(last, tool.id)) continue;
    wide.tools.push_back(tool);
    const Vec3 *const first = trajectory.points.get().data() + column_of(trajectory, tool.id);
    held.insert(held.end(), first, first + points_of_tool(tool));
  }
  wide.points = held;
  wide.steps_per_row = {1};
  for (size_t row = 0; row * columns < trajectory.points.size(); ++row)
    add_row(wide, trajectory, row);
  drop_front(wide.points.edit(), points_per_row(wide));
  drop_front(wide.steps_per_row.edit(), 1);
  wide.count = trajectory.count;
  return wide;
}

bool is_consistent(const RecordedEvent &trajectory) {
  uint64_t steps = 0;
  for (const uint32_t count : trajectory.steps_per_row.get()) {
    if (count == 0) return false;
    steps += count;
  }
  const std::vector<Vec3> &points = trajectory.points;
  if (!std::all_of(points.begin(), points.end(), [](auto &p) { return p.allFinite(); }))
    return false;
  return steps > 0 && steps == trajectory.count && !trajectory.tools.empty() &&
         trajectory.points.size() == trajectory.steps_per_row.size() * points_per_row(trajectory);
}

void apply_row(State &state, const RecordedEvent &trajectory, size_t row) {
  const Vec3 *point = trajectory.points.get().data() + row * points_per_row(trajectory);
  for (const Tool &tool : trajectory.tools.get()) {
    const bool has_axis = points_of_tool(tool) == 2;
    move_tool(state, tool.id, point[0], has_axis ? point[1] : Vec3::Zero());
    point += points_of_tool(tool);
  }
}

}  // namespace mvs::core
