// Cost of the servo and regularity of its rate beside a running simulation.
//
//   bench_servo                      scenes S and M, 10 s each
//   bench_servo --scenes S --seconds 2
//   bench_servo --tool rod --device premium6
//   bench_servo --tool convex        a convex tool of 200 vertices that dips into the valve
//
// A simulated hand (haptic_drivers/hand) holds a Touch at 1 kHz on a thread of the library's,
// grasps the edge of a closed valve and swings 3 mm at 1 Hz; this thread hands over and steps the
// valve as fast as it can. With --tool rod it pushes with a rod instead and turns by 0.1 rad; on
// the device premium6 the rod's torque is rendered. "body" is the time that the servo took for a
// sample (mvs_device_sample.servo_s, wall time: what preempts it counts), "period" the time between
// two samples, "sync" and "step" the CPU time of handing over and of simulating. "late" counts
// periods above two. "fifo" says whether the system gave the servo's thread real-time priority;
// without it the worst periods are those of the machine's other work.
#include <mvs/mvs.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>
#include <vector>

namespace {

const std::map<std::string, uint32_t> scene_vertices = {{"S", 425}, {"M", 1700}};

double cpu_now() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double norm(const double *v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double quantile(std::vector<double> &values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

void print(const char *scene, const char *what, std::vector<double> &s) {
  std::printf("%-5s %-7s %8zu %9.1f %9.1f %9.1f %9.1f %9.1f\n", scene, what, s.size(),
              1e6 * quantile(s, 0.5), 1e6 * quantile(s, 0.99), 1e6 * quantile(s, 0.999),
              1e6 * quantile(s, 0.9999), 1e6 * quantile(s, 1));
}

// Where the hand begins: the vertex of the free edge that lies highest.
std::array<double, 3> highest_edge(mvs_sim *sim) {
  const mvs_snapshot *snapshot = nullptr;
  mvs::must(mvs_get_snapshot(sim, &snapshot));
  mvs_view edge = {}, x = {};
  mvs::must(mvs_snapshot_get_array(snapshot, MVS_ARRAY_FREE_EDGE_NODES, &edge));
  mvs::must(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  const auto *const nodes = static_cast<const uint32_t *>(edge.data);
  const auto *const places = static_cast<const double *>(x.data);
  std::array<double, 3> best = {0, 0, -1};
  for (uint64_t k = 0; k < edge.count; ++k) {
    const double *const p = places + 3 * nodes[k];
    if (p[2] > best[2]) best = {p[0], p[1], p[2]};
  }
  mvs_snapshot_release(snapshot);
  return best;
}

// 200 points of a Fibonacci lattice on a sphere of 2 mm.
std::vector<double> sphere() {
  constexpr int count = 200;
  constexpr double radius = 2e-3;
  std::vector<double> points;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count, angle = M_PI * (3 - std::sqrt(5.0)) * k;
    const double r = radius * std::sqrt(1 - z * z);
    points.insert(points.end(), {r * std::cos(angle), r * std::sin(angle), radius * z});
  }
  return points;
}

struct Times {
  double torque = 0, force = 0;  // largest of a sample, N m, N
  std::vector<double> body, period, free_sync, free_step, sync, step;
  uint64_t lost = 0;
};

struct Choice {
  std::string tool = "grasp", device = "touch";
};

class Scene {
 public:
  Scene(uint32_t vertices, const Choice &choice) : choice_(choice) {
    mvs_parametric_desc valve = {};
    valve.shape = MVS_SHAPE_FOUNDING;
    valve.struct_size = sizeof valve;
    valve.vertices = vertices;
    mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
    mvs::must(mvs_create(nullptr, &sim_));
    mvs::must(mvs_generate_valve(sim_, &valve));
    mvs::must(mvs_set_load(sim_, &systole));
    mvs::must(mvs_settle(sim_, nullptr, nullptr));
    open();
  }
  ~Scene() {
    mvs_device_close(device_);
    mvs_destroy(sim_);
  }
  Scene(const Scene &) = delete;
  Scene &operator=(const Scene &) = delete;

  Times play(double seconds) {
    Times times;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      turn(times);
      fetch(times);
    }
    return times;
  }
  bool is_realtime() const {
    mvs_device_info info = {};
    info.struct_size = sizeof info;
    mvs::must(mvs_device_get_info(device_, &info));
    return info.realtime == 1;
  }
  mvs_device_state state() const {
    mvs_device_state state = {};
    state.struct_size = sizeof state;
    mvs::must(mvs_device_get_state(device_, &state));
    return state;
  }

 private:
  void open() {
    mvs_device_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.driver = "hand";
    const bool rod = choice_.tool == "rod", is_convex = choice_.tool == "convex";
    std::string options = "device=" + choice_.device + "\nfrequency=1";
    options += rod         ? "\namplitude=0.003,0.003,0.006"
               : is_convex ? "\namplitude=0.003,0.003,0.003"
                           : "\namplitude=0.003,0.003,0";
    if (!is_convex) options += "\nfault=stuck_button\nfault_at=0.5";
    if (choice_.device == "premium6") options += "\nturn_amplitude=0.1,0,0";
    desc.options = options.c_str();
    mvs_device_view view = {};
    view.struct_size = sizeof view;
    const auto at = highest_edge(sim_);
    std::copy(at.begin(), at.end(), view.origin);
    if (rod) view.origin[2] += 4e-3;  // it begins off the tissue
    mvs_device_hand hand = {};
    hand.struct_size = sizeof hand;
    hand.mode = rod ? MVS_HAND_MODE_ROD : MVS_HAND_MODE_GRASP;
    hand.reach = 0.02;
    const std::vector<double> points = sphere();
    mvs_body_desc hull = {};
    if (is_convex) {
      view.origin[2] += 5e-3;
      hull.kind = MVS_BODY_KIND_HULL;
      hull.vertices = {points.data(), points.size() / 3, 3, MVS_TYPE_F64, 0};
      hand.mode = MVS_HAND_MODE_CONVEX;
      hand.bodies = &hull;
      hand.body_count = 1;
      hand.body_stride = sizeof hull;
    }
    mvs::must(mvs_device_open(&desc, &device_));
    mvs::must(mvs_device_set_view(device_, &view));
    mvs::must(mvs_device_set_hand(device_, &hand));
    mvs::must(mvs_device_start(device_));
    while (state().ticks < 10) {
    }
    mvs::must(mvs_device_arm(device_));
  }

  void turn(Times &times) {
    const double begin = cpu_now();
    mvs_device_report report = {};
    report.struct_size = sizeof report;
    mvs::must(mvs_device_sync(device_, sim_, &report));
    const double between = cpu_now();
    mvs::must(mvs_step(sim_, nullptr));
    (report.tool != 0 ? times.sync : times.free_sync).push_back(between - begin);
    (report.tool != 0 ? times.step : times.free_step).push_back(cpu_now() - between);
  }

  void fetch(Times &times) {
    mvs_device_sample rows[256] = {};
    uint64_t count = 0, lost = 0;
    do {
      mvs::must(mvs_device_take_samples(device_, rows, sizeof rows[0], 256, &count, &lost));
      times.lost += lost;
      for (uint64_t k = 0; k < count; ++k) {
        times.body.push_back(rows[k].servo_s);
        times.torque = std::max(times.torque, norm(rows[k].torque));
        times.force = std::max(times.force, norm(rows[k].force));
        if (last_ > 0) times.period.push_back(rows[k].time - last_);
        last_ = rows[k].time;
      }
    } while (count == 256);
  }

  Choice choice_;
  mvs_sim *sim_ = nullptr;
  mvs_device *device_ = nullptr;
  double last_ = 0;
};

void run(const std::string &name, double seconds, const Choice &choice) {
  Scene scene(scene_vertices.at(name), choice);
  Times times = scene.play(seconds);
  print(name.c_str(), "body", times.body);
  print(name.c_str(), "period", times.period);
  print(name.c_str(), "sync", times.sync);
  print(name.c_str(), "step", times.step);
  std::printf("%-5s %zu turns before the hand held a tool\n", name.c_str(), times.free_step.size());
  std::printf("%-5s largest force %.3g N, torque %.3g N m\n", name.c_str(), times.force,
              times.torque);
  const mvs_device_state state = scene.state();
  std::printf("%-5s fifo %s, late %llu of %llu, not fetched %llu, phase %u, cause %u\n",
              name.c_str(), scene.is_realtime() ? "granted" : "refused",
              static_cast<unsigned long long>(state.late),
              static_cast<unsigned long long>(state.ticks),
              static_cast<unsigned long long>(times.lost), state.phase, state.cause);
}

int bench(int argc, char **argv) {
  CLI::App app("What the servo costs, and how well it keeps its rate");
  std::vector<std::string> scenes = {"S", "M"};
  double seconds = 10;
  std::string tool = "grasp";
  app.add_option("--scenes", scenes, "S (425 vertices), M (1,700)")
      ->check(CLI::IsMember({"S", "M"}));
  app.add_option("--seconds", seconds, "of play, each")->check(CLI::Range(0.1, 3600.0));
  Choice choice;
  app.add_option("--tool", choice.tool, "of the hand")
      ->check(CLI::IsMember({"grasp", "rod", "convex"}));
  app.add_option("--device", choice.device, "that is simulated")
      ->check(CLI::IsMember({"touch", "premium6"}));
  CLI11_PARSE(app, argc, argv);
  std::printf("us\n%-5s %-7s %8s %9s %9s %9s %9s %9s\n", "scene", "what", "count", "p50", "p99",
              "p99.9", "p99.99", "max");
  for (const std::string &name : scenes) run(name, seconds, choice);
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_servo: %s\n", error.what());
    return 1;
  }
}
