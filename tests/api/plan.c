/* Plans replay to the same bits; journals survive a killed process. */
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "tests/founding.h"

static char path[64]; /* path of the open journal */
static mvs_id named(mvs_sim *sim, uint32_t kind, const char *name) {
  const mvs_snapshot *snapshot = NULL;
  mvs_part part = {0};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_find_part(snapshot, kind, name, &part));
  mvs_snapshot_release(snapshot);
  return part.id;
}

static mvs_sim *new_valve(uint32_t vertices) {
  mvs_sim *sim = NULL;
  mvs_parametric_desc desc = {
      .struct_size = sizeof desc, .vertices = vertices, .shape = MVS_SHAPE_FOUNDING};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &desc));
  return sim;
}

static void shorten(mvs_sim *sim, const char *name, double factor) {
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, 0, 0, factor, {{0}, 0, 0}};
  op.chord = named(sim, MVS_PART_CHORD, name);
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static void add_chord(mvs_sim *sim) {
  mvs_op_chord_add op = {.op = {sizeof op, MVS_OP_CHORD_ADD}, .name = "new one"};
  op.head = named(sim, MVS_PART_HEAD, "PM1");
  op.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, named(sim, MVS_PART_SCALLOP, "P2"), {0.4, 0.8, 0}};
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static void scale(mvs_sim *sim, double factor) {
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, factor, 0, 0};
  MUST(mvs_apply_op(sim, &op.op, NULL));
}

static void close_a_bit(mvs_sim *sim) {
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_settle_options options = {.struct_size = sizeof options, .max_iterations = 4};
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_settle(sim, &options, NULL));
  for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, NULL));
}

static void operate(mvs_sim *sim) {
  shorten(sim, "P2/3", 0.75);
  close_a_bit(sim);
  MUST(mvs_begin_group(sim, "repair"));
  add_chord(sim);
  scale(sim, 0.95);
  MUST(mvs_end_group(sim));
  close_a_bit(sim);
}

static char *plan_of(mvs_sim *sim, uint64_t *size) {
  const mvs_snapshot *snapshot = NULL;
  mvs_plan_options options = {.struct_size = sizeof options, .measures = 1, .author = "a surgeon"};
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_write_plan(snapshot, &options, NULL, 0, size));
  char *text = malloc(*size + 1);
  MUST(mvs_write_plan(snapshot, &options, text, *size, size));
  text[*size] = 0;
  mvs_snapshot_release(snapshot);
  return text;
}

static void a_plan_replays_to_the_same_bits(void) {
  mvs_sim *sim = new_valve(0), *again = new_valve(0), *other = new_valve(800);
  uint64_t size = 0, size_again = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  operate(sim);
  char *text = plan_of(sim, &size);
  CHECK(strstr(text, "\"regurgitant_orifice_area_m2\"") && strstr(text, "a surgeon"));
  CHECK(strstr(text, "\"factor\": 0.75") && strstr(text, "\"chord\": \"P2/3\""));
  const hash128 fresh = sim_hash(again);
  MUST(mvs_check_plan(again, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 1);
  CHECK(same_hash(fresh, sim_hash(again)));
  MUST(mvs_replay_plan(again, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 1 && replay.same_result == 1);
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  /* groups as well: one undo reverts both operations */
  MUST(mvs_undo(sim));
  MUST(mvs_undo(again));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  MUST(mvs_redo(sim));
  MUST(mvs_redo(again));
  /* on another valve, by name and place */
  MUST(mvs_replay_plan(other, text, size, &replay));
  CHECK(replay.operations == 3 && replay.same_valve == 0 && replay.same_result == 0);
  CHECK(named(other, MVS_PART_CHORD, "new one") != 0);
  char *third = plan_of(other, &size_again);
  CHECK(size_again > 0);
  free(third);
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
  mvs_destroy(other);
}

/* Entries hold their time of application; all other bytes of two plans can be compared. */
static void blank_times(char *text) {
  static const char key[] = "\"time\": \"";
  for (char *at = text; (at = strstr(at, key)) != NULL;) {
    for (at += strlen(key); *at && *at != '"'; ++at) *at = '-';
  }
}

static void a_replayed_plan_is_written_as_it_was_read(void) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200), *third = new_valve(200);
  uint64_t size = 0, size_again = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  operate(sim);
  char *text = plan_of(sim, &size);
  MUST(mvs_replay_plan(again, text, size, NULL));
  char *text_again = plan_of(again, &size_again);
  MUST(mvs_replay_plan(third, text_again, size_again, &replay));
  CHECK(replay.same_result == 1 && same_hash(sim_hash(sim), sim_hash(third)));
  blank_times(text);
  blank_times(text_again);
  CHECK(strcmp(text, text_again) == 0);
  free(text_again);
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
  mvs_destroy(third);
}

static void refused(mvs_sim *sim, const char *text, mvs_result code, const char *word) {
  const hash128 before = sim_hash(sim);
  MUST_FAIL(mvs_check_plan(sim, text, strlen(text), NULL), code, word);
  MUST_FAIL(mvs_replay_plan(sim, text, strlen(text), NULL), code, word);
  CHECK(same_hash(before, sim_hash(sim)));
}

#define PLAN(steps) "{\"format\":\"mvs-plan\",\"version\":1,\"steps\":[" steps "]}"

static void remove_blanks(char *text) {
  char *to = text;
  for (; *text; ++text) {
    if (*text != ' ' && *text != '\n') *to++ = *text;
  }
  *to = 0;
}

/* Consecutive equal steps are one entry of the plan, whether they were taken in one call or
 * several. */
static void equal_steps_are_counted_together(void) {
  static const char plan[] = PLAN(
      "{\"do\":\"load\",\"pressure_Pa\":9000,\"boundary_fraction\":1},"
      "{\"do\":\"step\",\"count\":2},{\"do\":\"step\",\"count\":3},"
      "{\"do\":\"step\",\"solver\":\"implicit\",\"count\":2}");
  mvs_sim *sim = new_valve(200), *stepped = new_valve(200);
  mvs_load_case load = {sizeof load, 0, 9000, 1};
  uint64_t size = 0;
  MUST(mvs_replay_plan(sim, plan, strlen(plan), NULL));
  MUST(mvs_set_load(stepped, &load));
  for (int k = 0; k < 7; ++k) MUST(mvs_step(stepped, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(stepped)));
  char *text = plan_of(sim, &size);
  remove_blanks(text);
  CHECK(strstr(text,
               "{\"do\":\"step\",\"count\":5},"
               "{\"do\":\"step\",\"count\":2,\"solver\":\"implicit\"}]"));
  free(text);
  mvs_destroy(sim);
  mvs_destroy(stepped);
}

/* A step with a budget is replayed with that budget, in an entry of its own. */
static void steps_keep_their_budget(void) {
  mvs_sim *sim = new_valve(200), *again = new_valve(200);
  const mvs_load_case load = {sizeof load, 0, 9000, 1};
  const mvs_step_options tight = {.struct_size = sizeof tight, .budget = 4};
  uint64_t size = 0;
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_step(sim, NULL));
  for (int k = 0; k < 3; ++k) MUST(mvs_step(sim, &tight));
  char *text = plan_of(sim, &size);
  MUST(mvs_replay_plan(again, text, size, NULL));
  CHECK(same_hash(sim_hash(sim), sim_hash(again)));
  remove_blanks(text);
  CHECK(strstr(text, "{\"do\":\"step\"},{\"do\":\"step\",\"count\":3,\"budget\":4}]"));
  free(text);
  mvs_destroy(sim);
  mvs_destroy(again);
}

/* A host that cancels at a given call of its progress callback. */
typedef struct host {
  int calls, stop_at;
  double share;
} host;

static int32_t tell(void *user, double share, double residual) {
  host *h = user;
  CHECK(share >= h->share && share <= 1 && residual >= 0);
  h->share = share;
  return ++h->calls == h->stop_at;
}

/* A replay of 1e12 steps ends when the host cancels, and the state is unchanged. */
static void a_cancelled_replay_changes_nothing(void) {
  static const char plan[] = PLAN(
      "{\"do\":\"annulus_scale\",\"factor\":0.9},"
      "{\"do\":\"step\",\"solver\":\"explicit\",\"count\":1000000000000}");
  host h = {0, 3, 0};
  mvs_sim_desc desc = {.struct_size = sizeof desc, .progress = tell, .user = &h};
  mvs_sim *sim = NULL, *undisturbed = new_valve(0);
  uint64_t size = 0;
  MUST(mvs_create(&desc, &sim));
  MUST(generate_founding(sim));
  MUST(mvs_step(sim, NULL));
  MUST(mvs_step(undisturbed, NULL));
  char *before = plan_of(sim, &size);
  MUST_FAIL(mvs_replay_plan(sim, plan, strlen(plan), NULL), MVS_E_CANCELLED,
            "step 2 of the plan: ");
  CHECK(h.calls == 3 && h.share > 0);
  char *after = plan_of(sim, &size);
  CHECK(strcmp(before, after) == 0);
  MUST(mvs_step(sim, NULL));
  MUST(mvs_step(undisturbed, NULL));
  CHECK(same_hash(sim_hash(undisturbed), sim_hash(sim)));
  free(after);
  free(before);
  mvs_destroy(undisturbed);
  mvs_destroy(sim);
}

static void plans_that_cannot_be_done_are_told(void) {
  mvs_sim *sim = new_valve(0);
  refused(sim, "", MVS_E_FORMAT, "not JSON");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":1,\"steps\":[", MVS_E_FORMAT, "cut short");
  refused(sim, "[1]", MVS_E_FORMAT, "not a plan");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":2,\"steps\":[]}", MVS_E_VERSION,
          "version 2, this libmvs reads version 1");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":0,\"steps\":[]}", MVS_E_VERSION, "version 0");
  refused(sim, "{\"format\":\"mvs-plan\",\"steps\":[]}", MVS_E_FORMAT, "no version");
  refused(sim, "{\"format\":\"mvs-plan\",\"version\":1}", MVS_E_FORMAT, "no \"steps\"");
  refused(sim, PLAN("1"), MVS_E_FORMAT, "step 1");
  refused(sim, PLAN("{\"do\":\"fly\"}"), MVS_E_VERSION, "\"fly\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"dt\":1}"), MVS_E_FORMAT, "no field \"dt\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"count\":2}"), MVS_E_FORMAT, "no field \"count\"");
  refused(sim, PLAN("{\"do\":\"settle\",\"budget\":9}"), MVS_E_FORMAT, "no field \"budget\"");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"Q1/1\",\"factor\":0.5}"), MVS_E_ID,
          "no chord named \"Q1/1\"");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"P2/3\",\"factor\":\"half\"}"),
          MVS_E_FORMAT, "factor has to be a number");
  refused(sim, PLAN("{\"do\":\"chord_length\",\"chord\":\"P2/3\",\"speed\":1}"), MVS_E_FORMAT,
          "no field \"speed\"");
  refused(sim,
          PLAN("{\"do\":\"annulus_scale\",\"factor\":0.9},"
               "{\"do\":\"chord_remove\",\"chord\":\"P2/3\"},"
               "{\"do\":\"chord_remove\",\"chord\":\"P2/3\"}"),
          MVS_E_ID, "step 3 of the plan: chord_remove: ");
  refused(sim,
          PLAN("{\"do\":\"chord_add\",\"head\":\"PM1\",\"site\":{\"scallop\":\"P9\",\"along\":0,"
               "\"height\":1}}"),
          MVS_E_ID, "no scallop named \"P9\"; there are A");
  mvs_destroy(sim);
}

/* What a session with a journal does; the hash after each of its calls that count. */
enum { session_length = 9 };
static void session(mvs_sim *sim, int steps, hash128 *after) {
  for (int k = 0; k < steps; ++k) {
    if (k == 0) shorten(sim, "P2/3", 0.75);
    if (k == 1) close_a_bit(sim);
    if (k == 1) add_chord(sim);
    if (k == 2) MUST(mvs_undo(sim));
    if (k == 3) MUST(mvs_redo(sim));
    if (k == 4 || k == 5) close_a_bit(sim);
    if (k == 4) MUST(mvs_set_checkpoint(sim, "here"));
    if (k == 5) scale(sim, 0.9);
    if (k == 6) MUST(mvs_restore_checkpoint(sim, "here"));
    if (k == 7) scale(sim, 1.1);
    if (k == 8) shorten(sim, "A2/2", 1.1);
    if (after) after[k] = sim_hash(sim);
  }
}

static char *whole_file(size_t *size) {
  FILE *file = fopen(path, "rb");
  char *bytes = calloc(1, 1 << 20);
  if (!file || !bytes) exit(2);
  *size = fread(bytes, 1, 1 << 20, file);
  fclose(file);
  return bytes;
}

static void write_file(const char *bytes, size_t size) {
  FILE *file = fopen(path, "wb");
  CHECK(file && fwrite(bytes, 1, size, file) == size);
  if (file) fclose(file);
}

/* A child process is killed after each record; the session is recovered, and the journal continues.
 * */
static void a_killed_process_loses_nothing(void) {
  hash128 wanted[session_length];
  mvs_sim *whole = new_valve(200);
  session(whole, session_length, wanted);
  for (int steps = 1; steps <= session_length; ++steps) {
    remove(path);
    const pid_t child = fork();
    if (child == 0) {
      mvs_sim *sim = new_valve(200);
      MUST(mvs_open_journal(sim, path));
      session(sim, steps, NULL);
      kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    mvs_sim *sim = new_valve(200);
    mvs_replay replay = {.struct_size = sizeof replay};
    MUST(mvs_recover_journal(sim, path, &replay));
    CHECK(same_hash(wanted[steps - 1], sim_hash(sim)));
    MUST(mvs_close_journal(sim));
    mvs_destroy(sim);
  }
  mvs_destroy(whole);
}

/* The last record is cut at many bytes: the records before it are recovered. */
static void a_torn_record_is_dropped(void) {
  hash128 wanted[session_length];
  size_t size = 0;
  mvs_sim *sim = new_valve(200);
  remove(path);
  MUST(mvs_open_journal(sim, path));
  session(sim, session_length, wanted);
  mvs_destroy(sim);
  char *bytes = whole_file(&size);
  size_t last = size > 0 ? size - 1 : 0;
  while (last > 0 && bytes[last - 1] != '\n') --last;
  for (size_t cut = last; cut < size; cut += (size - last) / 7 + 1) {
    write_file(bytes, cut);
    sim = new_valve(200);
    MUST(mvs_recover_journal(sim, path, NULL));
    CHECK(same_hash(wanted[session_length - 2], sim_hash(sim)));
    /* it continues after the last complete record */
    shorten(sim, "A2/2", 1.1);
    CHECK(same_hash(wanted[session_length - 1], sim_hash(sim)));
    mvs_destroy(sim);
    sim = new_valve(200);
    MUST(mvs_recover_journal(sim, path, NULL));
    CHECK(same_hash(wanted[session_length - 1], sim_hash(sim)));
    mvs_destroy(sim);
  }
  /* damage in the middle is reported as an error */
  bytes[size / 2] ^= 1;
  write_file(bytes, size);
  sim = new_valve(200);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_FORMAT, "is damaged, and others follow");
  write_file("v 0 0 0\n", 8);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_FORMAT, "not a journal");
  MUST_FAIL(mvs_open_journal(sim, path), MVS_E_STATE, "is there already");
  MUST_FAIL(mvs_open_journal(sim, "/nowhere/at/all"), MVS_E_IO, "cannot create");
  MUST_FAIL(mvs_close_journal(sim), MVS_E_STATE, "no journal is open");
  bytes[size / 2] ^= 1;
  write_file(bytes, size);
  scale(sim, 0.9);
  MUST_FAIL(mvs_recover_journal(sim, path, NULL), MVS_E_STATE, "load that valve first");
  mvs_destroy(sim);
  free(bytes);
}

static void a_restored_snapshot_is_recovered_with_its_history(void) {
  const mvs_snapshot *early = NULL;
  mvs_sim *sim = new_valve(200);
  remove(path);
  shorten(sim, "P2/3", 0.75); /* before the journal starts: its first record includes it */
  MUST(mvs_open_journal(sim, path));
  close_a_bit(sim);
  MUST(mvs_set_checkpoint(sim, "one"));
  MUST(mvs_get_snapshot(sim, &early));
  scale(sim, 0.9);
  MUST(mvs_set_checkpoint(sim, "one"));
  MUST(mvs_restore(sim, early));
  scale(sim, 1.05);
  const hash128 wanted = sim_hash(sim);
  MUST(mvs_undo(sim));
  MUST(mvs_restore_checkpoint(sim, "one"));
  const hash128 one = sim_hash(sim);
  mvs_destroy(sim);
  sim = new_valve(200);
  MUST(mvs_recover_journal(sim, path, NULL));
  CHECK(same_hash(one, sim_hash(sim)));
  scale(sim, 1.05);
  CHECK(same_hash(wanted, sim_hash(sim)));
  MUST(mvs_undo(sim));
  MUST(mvs_undo(sim));
  mvs_destroy(sim);
  mvs_snapshot_release(early);
}

int main(void) {
  snprintf(path, sizeof path, "plan_test_%d.journal", (int)getpid());
  a_plan_replays_to_the_same_bits();
  a_replayed_plan_is_written_as_it_was_read();
  equal_steps_are_counted_together();
  steps_keep_their_budget();
  a_cancelled_replay_changes_nothing();
  plans_that_cannot_be_done_are_told();
  a_killed_process_loses_nothing();
  a_torn_record_is_dropped();
  a_restored_snapshot_is_recovered_with_its_history();
  remove(path);
  return finish("plan");
}
