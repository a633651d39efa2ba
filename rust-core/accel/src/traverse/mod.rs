//! Traversal by single rays, packets and ray streams, and the queries that choose among them.

pub(crate) mod beam;
mod packet;
mod packet_mesh;
mod packet_query;
mod packet_scene;
mod query;
mod scene_leaf;
mod single;
mod single_mesh;
mod single_scene;
mod single_within;
mod stream;
mod stream_ray;
mod stream_scene;
pub(crate) mod stream_tuner;
