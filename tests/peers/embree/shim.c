// Embree 3 behind a few plain functions: rays come as columns, one entry a ray.
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <xmmintrin.h>

// More meshes than any of the benchmark's worlds has.
enum { MOST_MESHES = 4 };

typedef struct {
  const float *origin[3], *direction[3], *t_min, *t_max;
} Rays;

typedef struct {
  RTCDevice device;
  RTCScene scene;
} Peer;

static double seconds(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// The processor time of this thread, which other processes do not lengthen.
double peer_thread_seconds(void) { return seconds(CLOCK_THREAD_CPUTIME_ID); }

void peer_flush_denormals(void) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

typedef struct {
  const float *positions;
  size_t points;
  const uint32_t *triangles;
  size_t count;
} Mesh;

// The rows of a map from object to world.
typedef struct {
  uint32_t mesh;
  float rows[12];
} Placement;

static RTCScene new_scene(RTCDevice device, int robust) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  return scene;
}

static void attach(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

static void attach_mesh(RTCDevice device, RTCScene scene, const Mesh *mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh->points), mesh->positions, 12 * mesh->points);
  memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh->count), mesh->triangles, 12 * mesh->count);
  attach(scene, geometry);
}

// Builds a scene of placed meshes, or of the meshes themselves where nothing is placed, and returns the seconds of all commits.
double peer_new(Peer *peer, const Mesh *meshes, size_t mesh_count, const Placement *placements, size_t placed, int robust, const char *config) {
  RTCScene parts[MOST_MESHES];
  double start, commits = 0;
  peer->device = rtcNewDevice(config);
  peer->scene = new_scene(peer->device, robust);
  for (size_t i = 0; i < mesh_count; i++) {
    parts[i] = placed ? new_scene(peer->device, robust) : peer->scene;
    attach_mesh(peer->device, parts[i], &meshes[i]);
    if (!placed) continue;
    start = seconds(CLOCK_MONOTONIC);
    rtcCommitScene(parts[i]);
    commits += seconds(CLOCK_MONOTONIC) - start;
  }
  for (size_t i = 0; i < placed; i++) {
    RTCGeometry instance = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, parts[placements[i].mesh]);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, placements[i].rows);
    attach(peer->scene, instance);
  }
  for (size_t i = 0; placed && i < mesh_count; i++) rtcReleaseScene(parts[i]);
  start = seconds(CLOCK_MONOTONIC);
  rtcCommitScene(peer->scene);
  return commits + seconds(CLOCK_MONOTONIC) - start;
}

// Builds a scene of round linear curves, and returns the seconds of the commit. Points have radii; each index is a piece's first point.
double peer_new_curves(Peer *peer, const float *points, size_t count, const uint32_t *pieces, const uint8_t *flags, size_t piece_count, int robust) {
  peer->device = rtcNewDevice("threads=1");
  peer->scene = new_scene(peer->device, robust);
  RTCGeometry geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, count), points, 16 * count);
  memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, piece_count), pieces, 4 * piece_count);
  memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, piece_count), flags, piece_count);
  attach(peer->scene, geometry);
  double start = seconds(CLOCK_MONOTONIC);
  rtcCommitScene(peer->scene);
  return seconds(CLOCK_MONOTONIC) - start;
}

void peer_free(Peer *peer) {
  rtcReleaseScene(peer->scene);
  rtcReleaseDevice(peer->device);
}

void peer_version(char *out, size_t size) {
  RTCDevice device = rtcNewDevice("threads=1");
  snprintf(out, size, "%ld.%ld.%ld", (long)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR),
           (long)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MINOR),
           (long)rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
}

static void fill(struct RTCRay *ray, const Rays *rays, size_t i) {
  ray->org_x = rays->origin[0][i], ray->org_y = rays->origin[1][i], ray->org_z = rays->origin[2][i];
  ray->dir_x = rays->direction[0][i], ray->dir_y = rays->direction[1][i], ray->dir_z = rays->direction[2][i];
  ray->tnear = rays->t_min[i], ray->tfar = rays->t_max[i];
  ray->time = 0, ray->mask = ~0u, ray->id = 0, ray->flags = 0;
}

static void start(struct RTCIntersectContext *context, int coherent) {
  rtcInitIntersectContext(context);
  context->flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

void peer_first_hit(const Peer *peer, const Rays *rays, size_t n, int coherent, float *t, uint32_t *primitive) {
  struct RTCIntersectContext context;
  start(&context, coherent);
  for (size_t i = 0; i < n; i++) {
    struct RTCRayHit hit;
    fill(&hit.ray, rays, i);
    hit.hit.geomID = hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(peer->scene, &context, &hit);
    t[i] = hit.ray.tfar, primitive[i] = hit.hit.primID;
  }
}

// Never told to be coherent: packets of coherent shadow rays may not come back from among instances, and win nothing elsewhere.
void peer_occluded(const Peer *peer, const Rays *rays, size_t n, uint8_t *out) {
  struct RTCIntersectContext context;
  start(&context, 0);
  for (size_t i = 0; i < n; i++) {
    struct RTCRay ray;
    fill(&ray, rays, i);
    rtcOccluded1(peer->scene, &context, &ray);
    out[i] = ray.tfar < 0;
  }
}

static void fill16(struct RTCRay16 *ray, const Rays *rays, size_t i) {
  memcpy(ray->org_x, rays->origin[0] + i, 64), memcpy(ray->org_y, rays->origin[1] + i, 64), memcpy(ray->org_z, rays->origin[2] + i, 64);
  memcpy(ray->dir_x, rays->direction[0] + i, 64), memcpy(ray->dir_y, rays->direction[1] + i, 64);
  memcpy(ray->dir_z, rays->direction[2] + i, 64);
  memcpy(ray->tnear, rays->t_min + i, 64), memcpy(ray->tfar, rays->t_max + i, 64);
  memset(ray->time, 0, 64), memset(ray->mask, 0xff, 64), memset(ray->id, 0, 64), memset(ray->flags, 0, 64);
}

// n is a multiple of 16.
void peer_first_hit16(const Peer *peer, const Rays *rays, size_t n, int coherent, float *t, uint32_t *primitive) {
  struct RTCIntersectContext context;
  start(&context, coherent);
  int valid[16] __attribute__((aligned(64)));
  memset(valid, 0xff, sizeof valid);
  for (size_t i = 0; i < n; i += 16) {
    struct RTCRayHit16 hit;
    fill16(&hit.ray, rays, i);
    memset(hit.hit.geomID, 0xff, 64), memset(hit.hit.primID, 0xff, 64), memset(hit.hit.instID[0], 0xff, 64);
    rtcIntersect16(valid, peer->scene, &context, &hit);
    memcpy(t + i, hit.ray.tfar, 64), memcpy(primitive + i, hit.hit.primID, 64);
  }
}

// n is a multiple of 16.
void peer_occluded16(const Peer *peer, const Rays *rays, size_t n, uint8_t *out) {
  struct RTCIntersectContext context;
  start(&context, 0);
  int valid[16] __attribute__((aligned(64)));
  memset(valid, 0xff, sizeof valid);
  for (size_t i = 0; i < n; i += 16) {
    struct RTCRay16 ray;
    fill16(&ray, rays, i);
    rtcOccluded16(valid, peer->scene, &context, &ray);
    for (int lane = 0; lane < 16; lane++) out[i + lane] = ray.tfar[lane] < 0;
  }
}
