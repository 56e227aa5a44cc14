/* Callbacks of the C interface for JavaScript: C functions that call the module with the number
 * that stands for a set of JavaScript functions (src/calls.ts). JavaScript never throws through
 * them. */
#include <emscripten.h>
#include <mvs/mvs.h>

/* clang-format off */
EM_JS(void, mvs_js_on_log, (uintptr_t user, uint32_t level, const char *text), {
  Module["onLog"](user, level, text);
})
EM_JS(int32_t, mvs_js_on_progress, (uintptr_t user, double share, double residual), {
  return Module["onProgress"](user, share, residual);
})
EM_JS(void, mvs_js_on_fault, (uintptr_t user, const char *part, const char *sentence), {
  Module["onFault"](user, part, sentence);
})
/* clang-format on */

static void on_log(void *user, mvs_log_level level, const char *text) {
  mvs_js_on_log((uintptr_t)user, level, text);
}

static int32_t on_progress(void *user, double share, double residual) {
  return mvs_js_on_progress((uintptr_t)user, share, residual);
}

static void on_fault(void *user, const char *part, const char *sentence) {
  mvs_js_on_fault((uintptr_t)user, part, sentence);
}

/* Return the addresses of these functions. */
uintptr_t mvs_js_log(void);
uintptr_t mvs_js_progress(void);
uintptr_t mvs_js_fault(void);

uintptr_t mvs_js_log(void) {
  return (uintptr_t)on_log;
}

uintptr_t mvs_js_progress(void) {
  return (uintptr_t)on_progress;
}

uintptr_t mvs_js_fault(void) {
  return (uintptr_t)on_fault;
}
