// The picture by WebGL 2: groups are layers of an array of integer textures, whose codes the fragments sum as light.

const VERTICES = `#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

const FRAGMENTS = (count) => `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2DArray;
uniform usampler2DArray lights;
uniform float low[${count}], perStop, height, split, scale, rise, candela;
uniform vec3 mixed[${count}], before[${count}], ramp[${RAMP.length}];
uniform float edges[${RAMP.length - 1}];
uniform bool falseColour;
out vec4 shown;
void main() {
  ivec2 place = ivec2(int(gl_FragCoord.x), int(height - gl_FragCoord.y));
  bool isBefore = gl_FragCoord.x < split;
  vec3 light = vec3(0.0);
  for (int group = 0; group < ${count}; group++) {
    uvec3 code = texelFetch(lights, ivec3(place, group), 0).rgb;
    vec3 one = exp2(low[group] + (vec3(code) - 1.0) / perStop) * vec3(notEqual(code, uvec3(0u)));
    light += one * (isBefore ? before[group] : mixed[group]);
  }
  float y = dot(light, vec3(${WEIGHTS.join(', ')}));
  if (falseColour) {
    int step = 0;
    for (int edge = 0; edge < ${RAMP.length - 1}; edge++) step += int(y * candela >= edges[edge]);
    shown = vec4(ramp[step], 1.0);
    return;
  }
  y *= scale;
  vec3 x = clamp(light * scale * (1.0 + rise * y) / (1.0 + y), 0.0, 1.0);
  shown = vec4(mix(1.055 * pow(max(x, 1e-8), vec3(1.0 / 2.4)) - 0.055, 12.92 * x, vec3(lessThan(x, vec3(0.0031308)))), 1.0);
}`;

class ByGl {
  // Null where there is no WebGL 2, or no room in it.
  static on(canvas, light) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl || Math.max(light.width, light.height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return null;
    const program = ByGl.program(gl, light.codes.length);
    if (!program) return null;
    const made = new ByGl();
    Object.assign(made, { gl, program, light });
    made.upload();
    return gl.getError() === gl.NO_ERROR ? made : null;
  }

  static program(gl, count) {
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTICES], [gl.FRAGMENT_SHADER, FRAGMENTS(count)]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
  }

  upload() {
    const { gl, light } = this;
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, gl.createTexture());
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGB16UI, light.width, light.height, light.codes.length);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
    light.codes.forEach((codes, group) => {
      const size = [light.width, light.height, 1];
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, group, ...size, gl.RGB_INTEGER, gl.UNSIGNED_SHORT, codes);
    });
  }

  draw(view) {
    const { gl, program, light } = this;
    const place = (name) => gl.getUniformLocation(program, name);
    gl.viewport(0, 0, light.width, light.height);
    gl.useProgram(program);
    gl.uniform1fv(place('low'), light.data.groups.map((group) => group.low));
    gl.uniform3fv(place('mixed'), view.mixed.flat());
    gl.uniform3fv(place('before'), view.before.flat());
    gl.uniform3fv(place('ramp'), RAMP.flat().map((x) => x / 255));
    gl.uniform1fv(place('edges'), view.edges);
    gl.uniform1i(place('falseColour'), view.falseColour ? 1 : 0);
    const numbers = { perStop: light.data.perStop, height: light.height, candela: 1 / light.data.exposure };
    for (const [name, value] of Object.entries({ ...numbers, split: view.split, scale: view.scale, rise: view.rise })) {
      gl.uniform1f(place(name), value);
    }
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Red, green, blue and 255 of every pixel, rows from the top.
  pixels() {
    const { gl, light: { width, height } } = this;
    const upward = new Uint8Array(4 * width * height), out = new Uint8Array(upward.length);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, upward);
    for (let y = 0; y < height; y++) out.set(upward.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
    return out;
  }
}
