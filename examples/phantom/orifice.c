/* Measures the regurgitant orifice on a second thread: a haptic device needs a new tissue model
 * before the measure is finished. A snapshot can be measured on any thread. */
#include <pthread.h>

#include "phantom.h"

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static const mvs_snapshot *measured; /* the last one; owned */
static double area;
static int at_work, started;
static pthread_t thread;

static void *look(void *snapshot) {
  const mvs_snapshot *const valve = snapshot;
  mvs_measures m = {0};
  m.struct_size = sizeof m;
  must(mvs_snapshot_measure(valve, &m));
  pthread_mutex_lock(&mutex);
  mvs_snapshot_release(measured);
  measured = valve;
  area = m.regurgitant_orifice_area;
  at_work = 0;
  pthread_mutex_unlock(&mutex);
  return NULL;
}

static int busy(void) {
  int answer;
  pthread_mutex_lock(&mutex);
  answer = at_work;
  pthread_mutex_unlock(&mutex);
  return answer;
}

void orifice_look(const mvs_snapshot *valve, int wait) {
  if (!wait && busy()) return;
  if (started) pthread_join(thread, NULL);
  started = 0;
  mvs_snapshot_retain(valve);
  at_work = 1;
  if (!wait && pthread_create(&thread, NULL, look, (void *)valve) == 0) {
    started = 1;
  } else {
    look((void *)valve);
  }
}

double orifice_area(const mvs_snapshot **of) {
  double answer;
  pthread_mutex_lock(&mutex);
  answer = area;
  mvs_snapshot_retain(measured);
  if (of)
    *of = measured;
  else
    mvs_snapshot_release(measured);
  pthread_mutex_unlock(&mutex);
  return answer;
}

void orifice_close(void) {
  if (started) pthread_join(thread, NULL);
  mvs_snapshot_release(measured);
  measured = NULL;
}
