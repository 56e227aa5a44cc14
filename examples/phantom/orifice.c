/* Measures the regurgitant orifice on a second thread: a haptic device needs a new tissue model
 * before the measure is finished. A snapshot can be measured on any thread. */
#include <pthread.h>

#include "phantom.h"

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static orifice last; /* its valve is owned */
static int at_work, started;
static pthread_t thread;

static void *look(void *snapshot) {
  const mvs_snapshot *const valve = snapshot;
  mvs_measures m = {0};
  m.struct_size = sizeof m;
  must(mvs_snapshot_measure(valve, &m));
  pthread_mutex_lock(&mutex);
  mvs_snapshot_release(last.valve);
  last.valve = valve;
  last.area = m.regurgitant_orifice_area;
  last.at_rest = (int)m.at_rest;
  last.under_load = (int)m.under_load;
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

orifice orifice_last(void) {
  orifice answer;
  pthread_mutex_lock(&mutex);
  mvs_snapshot_retain(last.valve);
  answer = last;
  pthread_mutex_unlock(&mutex);
  return answer;
}

double orifice_area(void) {
  const orifice answer = orifice_last();
  mvs_snapshot_release(answer.valve);
  return answer.area;
}

void orifice_close(void) {
  if (started) pthread_join(thread, NULL);
  mvs_snapshot_release(last.valve);
  last.valve = NULL;
}
