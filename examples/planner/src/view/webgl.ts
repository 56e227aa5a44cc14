// WebGL renderer on three.js: the same light and colours as the rasteriser, by one small shader. A lost
// context comes back by itself; three.js makes its buffers anew. Chromium's emulation of WebGL (`#webgl` without a graphics
// processor) lets chordae show between triangles of the leaflets, in single samples of 10 to 39 pixels; without multisampling,
// and in the rasteriser, no chord shows there.
import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  Color,
  ColorManagement,
  DoubleSide,
  FrontSide,
  LinearSRGBColorSpace,
  Matrix4,
  Mesh as Object3,
  PerspectiveCamera,
  RawShaderMaterial,
  GLSL3,
  Scene as Scene3,
  Vector2,
  Vector4,
  WebGLRenderer,
} from 'three';
import type { Camera } from './camera';
import { shadeGlsl } from './light';
import type { Mesh } from './mesh';
import type { Renderer, Scene } from './renderer';

const vertexShader = `precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position, normal, front, back;
out vec3 vNormal, vFront, vBack, vPosition;
void main() {
  vNormal = mat3(modelViewMatrix) * normal; vFront = front; vBack = back; vPosition = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const fragmentShader = `precision highp float;
uniform vec4 plane; uniform float opacity, flatColour, backOnly;
in vec3 vNormal, vFront, vBack, vPosition;
out vec4 colour;
${shadeGlsl}
void main() {
  if (dot(plane.xyz, vPosition) > plane.w) discard;
  // three.js turns the winding of a mesh round of which only the back is drawn
  bool front = gl_FrontFacing != (backOnly > 0.5);
  vec3 n = normalize(vNormal) * (front ? 1.0 : -1.0);
  vec3 c = front ? vFront : vBack;
  colour = vec4(flatColour > 0.5 ? c : shade(c, n), opacity);
}`;

interface Drawn {
  source: Mesh;
  object: Object3;
  material: RawShaderMaterial;
}

export class WebGl implements Renderer {
  readonly name = 'webgl';
  private renderer: WebGLRenderer;
  private scene = new Scene3();
  private camera = new PerspectiveCamera();
  private drawn: Drawn[] = [];
  private size = [1, 1, 1];

  /** A renderer; null where the browser has no WebGL 2, or emulates it on the processor, unless that is wanted. */
  static make(emulated: boolean, onLost: () => void, onRestored: () => void): WebGl | null {
    const canvas = document.createElement('canvas');
    const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'default' });
    if (!context) return null;
    const info = context.getExtension('WEBGL_debug_renderer_info');
    const name = info ? String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
    if (!emulated && /swiftshader|llvmpipe|softpipe|basic render/i.test(name)) return null;
    return new WebGl(canvas, context, onLost, onRestored);
  }

  private constructor(
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    onLost: () => void,
    onRestored: () => void,
  ) {
    this.renderer = new WebGLRenderer({
      canvas,
      context,
      antialias: true,
      preserveDrawingBuffer: false,
    });
    // colours are those of the screen, as in the rasteriser
    ColorManagement.enabled = false;
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.sortObjects = true;
    this.camera.matrixAutoUpdate = false;
    canvas.addEventListener('webglcontextlost', (event) => (event.preventDefault(), onLost()));
    canvas.addEventListener('webglcontextrestored', onRestored);
  }

  resize(width: number, height: number, ratio: number): void {
    this.size = [width, height, Math.min(ratio, 2)];
  }

  draw(scene: Scene, camera: Camera, fast: boolean): void {
    const ratio = fast ? Math.min(1, this.size[2]) : this.size[2];
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    const now = this.renderer.getDrawingBufferSize(new Vector2());
    if (now.x !== Math.floor(this.size[0] * ratio) || now.y !== Math.floor(this.size[1] * ratio))
      this.renderer.setSize(this.size[0], this.size[1], false);
    this.update(scene);
    this.renderer.setClearColor(new Color().setRGB(...scene.background), 1);
    this.camera.matrixWorld.copy(new Matrix4().copy(camera.view).invert());
    this.camera.matrixWorldInverse.copy(camera.view);
    this.camera.projectionMatrix.copy(camera.projection);
    this.camera.projectionMatrixInverse.copy(camera.projection).invert();
    this.renderer.render(this.scene, this.camera);
  }

  private update(scene: Scene): void {
    while (this.drawn.length > scene.meshes.length) this.remove(this.drawn.pop()!);
    scene.meshes.forEach((mesh, k) => {
      const old = this.drawn[k];
      if (old?.source !== mesh) {
        if (old) this.remove(old);
        this.drawn[k] = this.make(mesh, k);
      }
      const { plane } = scene;
      const cut = plane && mesh.cut ? [...plane.normal, plane.offset] : [0, 0, 0, 1];
      this.drawn[k].material.uniforms.plane.value.set(...cut);
    });
  }

  private make(mesh: Mesh, order: number): Drawn {
    const geometry = new BufferGeometry();
    for (const name of ['position', 'normal', 'front', 'back'] as const) {
      const data = { position: mesh.positions, normal: mesh.normals, front: mesh.front, back: mesh.back }[
        name
      ];
      geometry.setAttribute(name, new BufferAttribute(data, 3));
    }
    geometry.setIndex(new BufferAttribute(mesh.index, 1));
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      side: mesh.only === 'front' ? FrontSide : mesh.only === 'back' ? BackSide : DoubleSide,
      forceSinglePass: true,
      transparent: mesh.opacity < 1 || mesh.overlay,
      depthWrite: mesh.opacity === 1 || mesh.overlay,
      uniforms: {
        plane: { value: new Vector4(0, 0, 0, 1) },
        opacity: { value: mesh.opacity },
        flatColour: { value: mesh.flat ? 1 : 0 },
        backOnly: { value: mesh.only === 'back' ? 1 : 0 },
      },
    });
    const object = new Object3(geometry, material);
    // an overlay hides nothing of itself but everything of the others; a mesh before it may have left depth read-only,
    // in which it cannot be cleared
    if (mesh.overlay)
      object.onBeforeRender = (renderer) => {
        (renderer as WebGLRenderer).state.buffers.depth.setMask(true);
        (renderer as WebGLRenderer).clearDepth();
      };
    object.frustumCulled = false;
    object.matrixAutoUpdate = false;
    object.renderOrder = (mesh.overlay ? 2000 : mesh.opacity < 1 ? 1000 : 0) + order;
    this.scene.add(object);
    return { source: mesh, object, material };
  }

  private remove(item: Drawn): void {
    this.scene.remove(item.object);
    item.object.geometry.dispose();
    item.material.dispose();
  }

  dispose(): void {
    for (const item of this.drawn) this.remove(item);
    this.renderer.dispose();
    this.canvas.remove();
  }
}
