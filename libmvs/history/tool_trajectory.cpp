// Runs of led steps: made, gone on with, followed.
#include "history/tool_trajectory.h"

#include <mvs/tool.h>

#include <algorithm>

namespace mvs::core {
namespace {

// A look at a history copies its last run when it goes on, so that runs are short; what comes with
// each is little beside so many rows.
constexpr size_t most_rows = 128;

bool is_stepped_alike(const RecordedEvent &a, const RecordedEvent &b) {
  return a.solver == b.solver && a.dt == b.dt && a.damping == b.damping && a.budget == b.budget &&
         a.max_iterations == b.max_iterations && a.residual == b.residual;
}

// Where the places of a tool begin in the rows of a lead; those of one row where it has none.
size_t place_of(const RecordedEvent &lead, Id tool) {
  size_t place = 0;
  for (const Tool &has : lead.tool.get()) {
    if (has.id == tool) break;
    place += places_of(has);
  }
  return place;
}

bool leads(const RecordedEvent &lead, Id tool) {
  const std::vector<Tool> &tools = lead.tool;
  return std::any_of(tools.begin(), tools.end(), [&](const Tool &t) { return t.id == tool; });
}

bool covers(const RecordedEvent &lead, const RecordedEvent &more) {
  const std::vector<Tool> &tools = more.tool;
  return std::all_of(tools.begin(), tools.end(), [&](const Tool &t) { return leads(lead, t.id); });
}

// Room for one more row, without more than a whole run will need.
template <typename Item>
std::vector<Item> &with_room(CowVector<Item> &items, size_t more, size_t most) {
  std::vector<Item> &all = items.edit();
  const size_t needed = all.size() + more;
  if (all.capacity() < needed) all.reserve(std::max(needed, std::min(2 * needed, most)));
  return all;
}

// Adds one row of `from`; hands that it does not have stay where they were in the last row.
void add_row(RecordedEvent &run, const RecordedEvent &from, size_t row) {
  const size_t width = places_in_row(run), start = run.way.size();
  std::vector<Vec3> &way = with_room(run.way, width, most_rows * width);
  with_room(run.pace, 1, most_rows).push_back(from.pace.get()[row]);
  const Vec3 *const rows = from.way.get().data() + row * places_in_row(from);
  for (const Tool &tool : run.tool.get()) {
    const bool is_there = leads(from, tool.id);
    const size_t place = place_of(from, tool.id);
    for (size_t k = 0; k < places_of(tool); ++k) {
      way.push_back(is_there ? rows[place + k] : way[start - width + (way.size() - start)]);
    }
  }
  run.count += from.pace.get()[row];
}

template <typename Item>
void drop_front(std::vector<Item> &items, size_t count) {
  items.erase(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(count));
}

void take_rows(RecordedEvent &run, RecordedEvent &more) {
  const size_t room = most_rows - std::min(most_rows, run.pace.size());
  const size_t rows = std::min(room, more.pace.size()), width = places_in_row(more);
  if (rows == 0 || !covers(run, more)) return;
  std::vector<Vec3> &left = more.way.edit();
  std::vector<uint32_t> &paces = more.pace.edit();
  RecordedEvent longer = run;
  for (size_t row = 0; row < rows; ++row) {
    add_row(rows == 1 ? run : longer, more, row);
    more.count -= paces[row];
  }
  if (rows > 1) run = std::move(longer);
  drop_front(left, rows * width);
  drop_front(paces, rows);
}

void take_steps(uint64_t &count, uint64_t &from, uint64_t most) {
  const uint64_t taken = std::min(from, most - std::min(most, count));
  count += taken;
  from -= taken;
}

}  // namespace

size_t places_of(const Tool &tool) {
  return tool.kind == MVS_TOOL_KIND_ROD ? 2 : 1;
}

size_t places_in_row(const RecordedEvent &lead) {
  size_t places = 0;
  for (const Tool &tool : lead.tool.get()) places += places_of(tool);
  return places;
}

RecordedEvent lead_of(const std::vector<RecordedEvent> &hands, const RecordedEvent &step) {
  RecordedEvent lead = step;
  lead.kind = RecordedEvent::lead;
  std::vector<Tool> tools;
  std::vector<Vec3> way;
  for (const RecordedEvent &hand : hands) {
    const Tool &moved = hand.tool.get()[0];
    Tool tool;
    tool.id = moved.id;
    tool.kind = moved.kind;
    tools.push_back(tool);
    way.push_back(moved.position);
    if (places_of(moved) == 2) way.push_back(moved.axis);
  }
  lead.tool = std::move(tools);
  lead.way = std::move(way);
  lead.pace = {static_cast<uint32_t>(step.count)};
  return lead;
}

void take_on(RecordedEvent &run, RecordedEvent &more) {
  if (!is_stepped_alike(run, more)) return;
  if (run.kind == RecordedEvent::step && more.kind == RecordedEvent::step) {
    take_steps(run.count, more.count, RecordedEvent::most_count);
  } else if (run.kind == RecordedEvent::lead && more.kind == RecordedEvent::lead) {
    take_rows(run, more);
  } else if (run.kind == RecordedEvent::lead && more.kind == RecordedEvent::step) {
    uint64_t last = run.pace.get().back();
    const uint64_t before = last;
    std::vector<uint32_t> &pace = run.pace.edit();
    take_steps(last, more.count, UINT32_MAX);
    pace.back() = static_cast<uint32_t>(last);
    run.count += last - before;
  }
}

RecordedEvent widened(const RecordedEvent &last, RecordedEvent lead) {
  const bool goes_on = last.kind == RecordedEvent::lead && lead.kind == RecordedEvent::lead &&
                       is_stepped_alike(last, lead) && last.pace.size() < most_rows;
  if (!goes_on) return lead;
  RecordedEvent wide = last;
  const size_t width = places_in_row(last), places = places_in_row(lead);
  std::vector<Vec3> held(last.way.end() - static_cast<std::ptrdiff_t>(width), last.way.end());
  for (const Tool &tool : lead.tool.get()) {
    if (leads(last, tool.id)) continue;
    wide.tool.push_back(tool);
    const Vec3 *const first = lead.way.get().data() + place_of(lead, tool.id);
    held.insert(held.end(), first, first + places_of(tool));
  }
  wide.way = held;
  wide.pace = {1};
  for (size_t row = 0; row * places < lead.way.size(); ++row) add_row(wide, lead, row);
  drop_front(wide.way.edit(), places_in_row(wide));
  drop_front(wide.pace.edit(), 1);
  wide.count = lead.count;
  return wide;
}

bool is_whole(const RecordedEvent &lead) {
  uint64_t steps = 0;
  for (const uint32_t pace : lead.pace.get()) {
    if (pace == 0) return false;
    steps += pace;
  }
  const std::vector<Vec3> &way = lead.way;
  if (!std::all_of(way.begin(), way.end(), [](auto &p) { return p.allFinite(); })) return false;
  return steps > 0 && steps == lead.count && !lead.tool.empty() &&
         lead.way.size() == lead.pace.size() * places_in_row(lead);
}

void take_row(State &state, const RecordedEvent &lead, size_t row) {
  const Vec3 *place = lead.way.get().data() + row * places_in_row(lead);
  for (const Tool &tool : lead.tool.get()) {
    const bool is_rod = places_of(tool) == 2;
    move_tool(state, tool.id, place[0], is_rod ? place[1] : Vec3::Zero());
    place += places_of(tool);
  }
}

}  // namespace mvs::core
