/* The window: GLFW and OpenGL 3.3, with functions loaded by name through GLFW. */
#define GLFW_INCLUDE_GLCOREARB
#include <GLFW/glfw3.h>
#include <stdlib.h>

#include "phantom.h"

/* The functions of OpenGL used here. */
#define FUNCTIONS(f)                                                                               \
  f(PFNGLATTACHSHADERPROC, glAttachShader) f(PFNGLBLENDFUNCPROC, glBlendFunc)                      \
      f(PFNGLDISABLEPROC, glDisable) f(PFNGLBINDBUFFERPROC, glBindBuffer) f(                       \
          PFNGLBINDVERTEXARRAYPROC, glBindVertexArray) f(PFNGLBUFFERDATAPROC, glBufferData)        \
          f(PFNGLCLEARPROC, glClear) f(PFNGLCLEARCOLORPROC, glClearColor) f(                       \
              PFNGLCOMPILESHADERPROC, glCompileShader) f(PFNGLCREATEPROGRAMPROC, glCreateProgram)  \
              f(PFNGLCREATESHADERPROC, glCreateShader) f(PFNGLDRAWARRAYSPROC, glDrawArrays)        \
                  f(PFNGLENABLEPROC, glEnable)                                                     \
                      f(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray)               \
                          f(PFNGLGENBUFFERSPROC, glGenBuffers)                                     \
                              f(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)                       \
                                  f(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                         \
                                      f(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)         \
                                          f(PFNGLLINKPROGRAMPROC, glLinkProgram) f(                \
                                              PFNGLPIXELSTOREIPROC, glPixelStorei)                 \
                                              f(PFNGLREADPIXELSPROC, glReadPixels) f(              \
                                                  PFNGLSHADERSOURCEPROC, glShaderSource)           \
                                                  f(PFNGLUNIFORMMATRIX4FVPROC, glUniformMatrix4fv) \
                                                      f(PFNGLUSEPROGRAMPROC, glUseProgram)         \
                                                          f(PFNGLVERTEXATTRIBPOINTERPROC,          \
                                                            glVertexAttribPointer)                 \
                                                              f(PFNGLVIEWPORTPROC, glViewport)

#define DECLARE(type, name) static type name;
FUNCTIONS(DECLARE)

static const char *const vertex_shader =
    "#version 330 core\n"
    "layout(location = 0) in vec3 at; layout(location = 1) in vec4 colour;\n"
    "uniform mat4 eye; out vec4 lit;\n"
    "void main() { lit = colour; gl_Position = eye * vec4(at, 1); }\n";
static const char *const fragment_shader =
    "#version 330 core\n"
    "in vec4 lit; out vec4 pixel;\n"
    "void main() { pixel = lit; }\n";

static const float background[3] = BACKGROUND;
static GLFWwindow *window;
static const char *reason;
static GLint eye_place;
static int keys[32], first_key, key_count;
static pointer mouse;
static int mouse_changed = 1; /* where it was before the window opened is news too */

static void note_error(int code, const char *text) {
  (void)code;
  reason = text;
}

static void add_key(int key) {
  if (key_count == 32) return; /* drop keys when the queue is full */
  keys[(first_key + key_count++) % 32] = key;
}

static void on_character(GLFWwindow *of, unsigned key) {
  (void)of;
  if (key < 128) add_key((int)key);
}

/* Arrow keys send the letters that rotate the view. */
static void on_key(GLFWwindow *of, int key, int code, int action, int modifiers) {
  (void)of, (void)code, (void)modifiers;
  if (action == GLFW_RELEASE) return;
  if (key == GLFW_KEY_LEFT) add_key('h');
  if (key == GLFW_KEY_DOWN) add_key('j');
  if (key == GLFW_KEY_UP) add_key('k');
  if (key == GLFW_KEY_RIGHT) add_key('l');
}

static void on_motion(GLFWwindow *of, double x, double y) {
  (void)of, (void)x, (void)y;
  mouse_changed = 1;
}

static void on_button(GLFWwindow *of, int button, int action, int modifiers) {
  (void)of, (void)modifiers;
  if (button == GLFW_MOUSE_BUTTON_LEFT) mouse.left = action == GLFW_PRESS;
  if (button == GLFW_MOUSE_BUTTON_RIGHT && action == GLFW_PRESS) mouse.right = 1;
  mouse_changed = 1;
}

static void on_wheel(GLFWwindow *of, double x, double y) {
  (void)of, (void)x;
  mouse.notches += y;
  mouse_changed = 1;
}

static int load_functions(void) {
#define LOAD(type, name) \
  if (!((name) = (type)glfwGetProcAddress(#name))) return 0;
  FUNCTIONS(LOAD)
  return 1;
}

static void add_shader(GLuint program, GLenum kind, const char *text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, NULL);
  glCompileShader(shader);
  glAttachShader(program, shader);
}

static int make_program(void) {
  const GLuint program = glCreateProgram();
  GLint good;
  add_shader(program, GL_VERTEX_SHADER, vertex_shader);
  add_shader(program, GL_FRAGMENT_SHADER, fragment_shader);
  glLinkProgram(program);
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  glUseProgram(program);
  eye_place = glGetUniformLocation(program, "eye");
  return good;
}

/* One buffer, refilled for each picture. */
static void make_buffer(void) {
  /* OpenGL takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr) */
  const void *const colours = (const void *)offsetof(corner, colour);
  GLuint array, buffer;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(corner), NULL);
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(corner), colours);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(background[0], background[1], background[2], 1);
}

const char *window_open(int width, int height) {
  glfwSetErrorCallback(note_error);
  reason = "GLFW gives no reason";
  if (!glfwInit()) return reason;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  window = glfwCreateWindow(width, height, "phantom", NULL, NULL);
  if (!window) return reason;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(0); /* the simulation must not wait for the screen */
  if (!load_functions() || !make_program()) return "OpenGL is older than 3.3";
  make_buffer();
  glfwSetCharCallback(window, on_character);
  glfwSetKeyCallback(window, on_key);
  glfwSetCursorPosCallback(window, on_motion);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetScrollCallback(window, on_wheel);
  return NULL;
}

int window_key(void) {
  const int key = keys[first_key];
  if (key_count == 0) return 0;
  first_key = (first_key + 1) % 32;
  --key_count;
  return key;
}

int window_wants_to_close(void) {
  return glfwWindowShouldClose(window);
}

double window_aspect(void) {
  int width, height;
  glfwGetFramebufferSize(window, &width, &height);
  return width > 0 && height > 0 ? (double)width / height : 4.0 / 3;
}

/* A pointer outside of the window counts as one at its edge. */
int window_pointer(pointer *now) {
  double x, y;
  int width, height;
  if (!mouse_changed) return 0;
  glfwGetCursorPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  if (width == 0 || height == 0) return 0; /* minimised */
  x = x < 0 ? 0 : x > width ? width : x;
  y = y < 0 ? 0 : y > height ? height : y;
  mouse.x = (2 * x - width) / height;
  mouse.y = 1 - 2 * y / height;
  *now = mouse;
  mouse.notches = 0;
  mouse.right = mouse_changed = 0;
  return 1;
}

void window_wait(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

static int save(const char *path, int width, int height) {
  const size_t row = 3 * (size_t)width;
  unsigned char *const rgb = malloc(row * (size_t)height);
  int y, good;
  if (!rgb) return 0;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (y = 0; y < height; ++y) { /* OpenGL counts rows from the bottom */
    glReadPixels(0, height - 1 - y, width, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb + row * (size_t)y);
  }
  good = picture_write(path, rgb, width, height);
  free(rgb);
  return good;
}

int window_show(const scene *what, const eye *from, const char *title, const char *path) {
  float matrix[16];
  int width, height, good = 1;
  glfwSetWindowTitle(window, title);
  glfwGetFramebufferSize(window, &width, &height);
  if (width == 0 || height == 0) return path == NULL; /* minimised */
  glViewport(0, 0, width, height);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  eye_matrix(from, matrix);
  glUniformMatrix4fv(eye_place, 1, GL_FALSE, matrix);
  glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(what->count * sizeof(corner)), what->corners,
               GL_STREAM_DRAW);
  glEnable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, (GLsizei)what->solid);
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, (GLint)what->solid, (GLsizei)(what->count - what->solid));
  if (path) good = save(path, width, height);
  glfwSwapBuffers(window);
  return good;
}

void window_close(void) {
  glfwTerminate();
}
