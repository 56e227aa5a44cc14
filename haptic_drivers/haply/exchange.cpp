// Exchange loop with the service.
#include "exchange.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/socket.h>

#include <algorithm>
#include <ctime>
#include <exception>

namespace haply {
namespace {

// ms, longest wait for the service before stop() can send zero force.
constexpr int kSliceMs = 2;

// Limit of states read in one exchange.
constexpr int kStatesAtOnce = 64;

constexpr Force kZero = {};

void sleep_until(uint64_t time_ns) {
  timespec time = {};
  time.tv_sec = static_cast<time_t>(time_ns / 1000000000);
  time.tv_nsec = static_cast<long>(time_ns % 1000000000);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

// Blocks signals but those of its own faults in a new thread, so that the application's threads
// receive them.
class OwnFaultsOnly {
 public:
  OwnFaultsOnly() {
    sigset_t others;
    sigfillset(&others);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&others, fault);
    pthread_sigmask(SIG_BLOCK, &others, &before_);
  }
  ~OwnFaultsOnly() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  OwnFaultsOnly(const OwnFaultsOnly &) = delete;
  OwnFaultsOnly &operator=(const OwnFaultsOnly &) = delete;

 private:
  sigset_t before_;
};

}  // namespace

int32_t Exchange::open(const Inverse &inverse, const Grip &grip, Fault &fault) {
  device_ = inverse.id;
  grip_ = grip;
  sample_.hand.calibrated = inverse.calibrated;
  sample_.hand.powered = inverse.powered;
  commands_ = std::make_unique<Commands>(connection.version, device_);
  panic_frame_ = connection.socket.frame_of(commands_->force(kZero.newton));
  const std::string hello = commands_->hello(options_.preset);
  int32_t result = MVS_DRIVER_OK;
  if (!connection.socket.send_text(hello.data(), hello.size(), options_.timeout_ms))
    result = silent();
  // the second state is the first one after the preset has moved the origin
  for (int i = 0; i < 2 && result == MVS_DRIVER_OK; ++i)
    result = i == 0 ? listen(kZero) : tick(kZero);
  if (result != MVS_DRIVER_OK) return fault.set(result, "%s", why_.sentence);
  descriptor_ = connection.socket.descriptor();
  const OwnFaultsOnly blocked;
  thread_ = std::thread([this] { work(); });
  return MVS_DRIVER_OK;
}

Exchange::~Exchange() {
  allow(false);
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  connection.socket.close(options_.timeout_ms);  // if no thread was started
}

int Exchange::request_real_time() {
  sched_param wanted = {};
  wanted.sched_priority = 60;
  return pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &wanted);
}

void Exchange::panic() {
  allow(false);
  const int descriptor = descriptor_.load(std::memory_order_relaxed);
  if (descriptor >= 0)
    send(descriptor, panic_frame_.data(), panic_frame_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void Exchange::work() {
  int32_t result = MVS_DRIVER_OK;
  try {
    result = talk();
    say(kZero);
  } catch (const std::exception &failure) {
    result = why_.set(MVS_DRIVER_E_INTERNAL, "%s", failure.what());
    panic();
  }
  descriptor_ = -1;
  failure_.store(result, std::memory_order_release);
  connection.socket.close(options_.timeout_ms);
}

int32_t Exchange::talk() {
  const auto period = static_cast<uint64_t>(1e9 / options_.rate);
  int32_t result = MVS_DRIVER_OK;
  for (uint64_t next = monotonic_ns(); result == MVS_DRIVER_OK && !ending_;) {
    result = tick(wanted());
    // a late exchange is not repeated
    next = std::max(next + period, monotonic_ns());
    sleep_until(next);
  }
  return result;
}

Force Exchange::wanted() {
  const Force &force = forces_.get();
  return force.on && allowed_.load(std::memory_order_acquire) ? force : kZero;
}

int32_t Exchange::tick(Force force) {
  return say(force) ? listen(force) : silent();
}

bool Exchange::say(const Force &force) {
  const std::string &text = commands_->force(force.newton);
  return connection.socket.send_text(text.data(), text.size(), options_.timeout_ms);
}

int32_t Exchange::silent() {
  return why_.set(MVS_DRIVER_E_LOST,
                  "the Haply Inverse Service has not reported device %.64s for %d ms: is it "
                  "plugged in? (systemctl status haply-inverse-service)",
                  device_.c_str(), options_.timeout_ms);
}

// Sends again if stop() was called during the wait, or if the service answered without the device:
// it then sends nothing before the next message.
bool Exchange::keep_asking(Force &force, bool answered) {
  const bool stopped = force.on && !allowed_.load(std::memory_order_acquire);
  if (stopped) force = kZero;
  if (answered) sleep_until(monotonic_ns() + 1000000);
  return (!stopped && !answered) || say(force);
}

// Waits for a state, and takes the newest one received.
int32_t Exchange::listen(Force force) {
  const uint64_t deadline = monotonic_ns() + static_cast<uint64_t>(options_.timeout_ms) * 1000000;
  for (int states = 0; states < kStatesAtOnce;) {
    const int32_t got = connection.socket.receive(text_, states ? 0 : kSliceMs, why_);
    const int32_t found = got == 1 ? read_state(text_, device_, grip_, sample_.hand, why_) : got;
    if (found < 0) return found;
    states += found;
    if (found == 1) continue;
    if (states > 0) break;
    if (monotonic_ns() > deadline) return silent();
    if (!keep_asking(force, got == 1)) return silent();
  }
  ++sample_.sequence;
  sample_.arrived_ns = monotonic_ns();
  sample_.force_on = force.on && sample_.hand.powered;
  samples_.put(sample_);
  return MVS_DRIVER_OK;
}

}  // namespace haply
