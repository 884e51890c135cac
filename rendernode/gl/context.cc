// EGL without a window system.
#include "rendernode/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "base/log.h"

namespace lfd::gl {
namespace {

std::atomic<int> errors{0};

void GLAPIENTRY on_debug(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*) {
  if (type == GL_DEBUG_TYPE_ERROR) {
    ++errors;
    log::error("GL: {}", message);
  } else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM) {
    log::debug("GL: {}", message);
  }
}

std::vector<EGLDeviceEXT> devices() {
  // Client extensions exist before any display; without them the entry points may be missing.
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
    return {};
  }
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count) || count == 0) return {};
  std::vector<EGLDeviceEXT> found(static_cast<std::size_t>(count));
  if (!eglQueryDevicesEXT(count, found.data(), &count)) return {};
  found.resize(static_cast<std::size_t>(count));
  return found;
}

// The core name eglGetPlatformDisplay aborts in libepoxy before a display exists; the extension's does not.
EGLDisplay device_display(EGLDeviceEXT device) {
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

EGLDisplay surfaceless_display() {
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
}

}  // namespace

bool Context::is_software() const {
  constexpr std::array<std::string_view, 3> kSoftware{"llvmpipe", "softpipe", "SwiftShader"};
  return std::ranges::any_of(kSoftware,
                             [&](std::string_view name) { return description_.find(name) != std::string::npos; });
}

bool Context::is_lost() {
  if (!lost_ && tells_resets_ && glGetGraphicsResetStatus() != GL_NO_ERROR) {
    log::warn("the GPU was reset: the GL context is lost");
    lost_ = true;
  }
  return lost_;
}

int Context::error_count() { return errors; }

Status Context::open(void* display) {
  if (display == EGL_NO_DISPLAY) return Error("no EGL display");
  EGLint major = 0, minor = 0;
  if (!eglInitialize(display, &major, &minor)) return Error(fmt::format("eglInitialize failed ({:#x})", eglGetError()));
  display_ = display;
  if (!eglBindAPI(EGL_OPENGL_API)) return Error("EGL has no desktop OpenGL");
  const std::array<EGLint, 3> config_wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display, config_wanted.data(), &config, 1, &configs) || configs == 0) config = EGL_NO_CONFIG_KHR;
  std::vector<EGLint> wanted{EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_CONTEXT_OPENGL_DEBUG,
                             EGL_TRUE,
                             EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                             EGL_LOSE_CONTEXT_ON_RESET,
                             EGL_NONE};
  context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, wanted.data());
  tells_resets_ = context_ != EGL_NO_CONTEXT;
  if (!tells_resets_) {
    wanted.erase(wanted.end() - 3, wanted.end() - 1);  // a driver that knows no resets
    context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, wanted.data());
  }
  if (context_ == EGL_NO_CONTEXT) return Error(fmt::format("no OpenGL 4.5 core context ({:#x})", eglGetError()));
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    return Error(fmt::format("eglMakeCurrent failed ({:#x})", eglGetError()));
  }
  if (!epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array")) {
    return Error("the driver lacks GL_ARB_shader_viewport_layer_array");
  }
  // GL promises a block of 16 KiB only; a node's modules need more (shaders/shared/bindings.glsl).
  GLint block_bytes = 0;
  glGetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &block_bytes);
  constexpr GLint kBlockBytes = 65536;
  if (block_bytes < kBlockBytes) {
    return Error(fmt::format("the driver's uniform blocks hold {} bytes; {} are needed", block_bytes, kBlockBytes));
  }
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_debug, nullptr);
  description_ = fmt::format("{}, {}, OpenGL {}", reinterpret_cast<const char*>(glGetString(GL_VENDOR)),
                             reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                             reinterpret_cast<const char*>(glGetString(GL_VERSION)));
  return {};
}

Result<std::unique_ptr<Context>> Context::create(int gpu) {
  LFD_TRY_STATUS(check_gpu(gpu));
  const auto found = devices();
  std::string reasons;
  const auto attempt = [&reasons](EGLDisplay display, const std::string& platform) -> std::unique_ptr<Context> {
    auto context = std::unique_ptr<Context>(new Context);
    if (auto status = context->open(display); !status) {
      reasons += "; " + status.error().message();
      return nullptr;
    }
    context->description_ += ", EGL " + platform;
    return context;
  };
  for (int i = 0; i < static_cast<int>(found.size()); ++i) {
    if (gpu >= 0 && i != gpu) continue;
    if (auto context = attempt(device_display(found[static_cast<std::size_t>(i)]), fmt::format("device {}", i)))
      return context;
  }
  if (gpu < 0) {
    if (auto context = attempt(surfaceless_display(), "surfaceless")) return context;
  }
  return Error("no usable OpenGL device" + reasons);
}

Context::~Context() {
  if (display_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != nullptr) eglDestroyContext(display_, context_);
  // The display itself stays initialised: EGL shares it within the process.
}

Status check_gpu(int gpu) {
  if (gpu < 0) return {};
  const std::size_t count = devices().size();
  if (static_cast<std::size_t>(gpu) < count) return {};
  return Error(fmt::format("gpu {}: there are {} (see lfd-rendernode --list-gpus)", gpu, count));
}

std::vector<Gpu> list_gpus() {
  std::vector<Gpu> gpus;
  const int count = static_cast<int>(devices().size());
  for (int i = count == 0 ? -1 : 0; i < count; ++i) {
    auto context = Context::create(i);
    gpus.push_back({i, context ? (*context)->description() : context.error().message(), static_cast<bool>(context)});
  }
  return gpus;
}

}  // namespace lfd::gl
