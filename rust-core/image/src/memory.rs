//! What memory this process may still have, so that what is too large is refused before it is asked for.

use std::{fmt, fs, path::Path};

/// Where Linux shows control groups, of the second and the first version.
const GROUPS: &str = "/sys/fs/cgroup";

/// Something that does not fit: bytes it takes, and bytes that are free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortage {
    wanted: u64,
    free: u64,
}

impl fmt::Display for Shortage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let gigabytes = |bytes: u64| bytes as f64 * 1e-9;
        write!(f, "{:.1} GB of memory are wanted, {:.1} GB are free", gigabytes(self.wanted), gigabytes(self.free))
    }
}

/// Whether there is room for so many bytes.
///
/// # Errors
/// There is not: the machine, the container or the limit of the process on addresses has less.
pub fn room_for(wanted: u64) -> Result<(), Shortage> {
    match free_memory() {
        Some(free) if free < wanted => Err(Shortage { wanted, free }),
        _ => Ok(()),
    }
}

/// Bytes that the process may still ask for: the least of what the machine, its control groups (containers, jobs of a scheduler) and its limits
/// (`ulimit -v`, `-d`) leave. `None` where the system does not tell.
pub fn free_memory() -> Option<u64> {
    machine_memory().into_iter().chain(left_by_limits()).min()
}

/// What the machine and the control groups leave alone.
pub fn machine_memory() -> Option<u64> {
    let machine = kibibytes(&text("/proc/meminfo"), "MemAvailable:");
    machine.into_iter().chain(left_by_groups(&text("/proc/self/cgroup"), Path::new(GROUPS))).min()
}

/// What the limits of the process leave.
fn left_by_limits() -> Option<u64> {
    let status = text("/proc/self/status");
    let limits = text("/proc/self/limits");
    let left = |limit: &str, used: &str| {
        let soft = line(&limits, limit)?.split_whitespace().next()?.parse::<u64>().ok()?;
        Some(soft.saturating_sub(kibibytes(&status, used)?))
    };
    [left("Max address space", "VmSize:"), left("Max data size", "VmData:")].into_iter().flatten().min()
}

/// What the control groups of a process leave, those around its own among them.
fn left_by_groups(own: &str, groups: &Path) -> Option<u64> {
    let left = own.lines().filter_map(|line| {
        let mut parts = line.splitn(3, ':');
        let (_, controllers, path) = (parts.next()?, parts.next()?, parts.next()?);
        let (root, names) = match controllers {
            "" => (groups.to_owned(), ["memory.max", "memory.current", "inactive_file "]),
            _ if controllers.split(',').any(|name| name == "memory") => {
                (groups.join("memory"), ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "])
            }
            _ => return None,
        };
        // A container may show its own group as the root.
        let path = Path::new(path.trim_start_matches('/'));
        path.ancestors().filter_map(|part| left_by_group(&root.join(part), names)).min()
    });
    left.min()
}

fn left_by_group(group: &Path, [limit, used, cached]: [&str; 3]) -> Option<u64> {
    let number = |name: &str| text(group.join(name)).trim().parse::<u64>().ok();
    let (limit, used) = (number(limit)?, number(used)?);
    // Files that were read are kept only while nothing else wants the room.
    let cached = line(&text(group.join("memory.stat")), cached).and_then(|bytes| bytes.trim().parse().ok()).unwrap_or(0);
    Some(limit.saturating_sub(used.saturating_sub(cached)))
}

fn text(path: impl AsRef<Path>) -> String {
    fs::read_to_string(path).unwrap_or_default()
}

/// What follows a name at a line's start.
fn line<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    text.lines().find_map(|line| line.strip_prefix(name))
}

fn kibibytes(text: &str, name: &str) -> Option<u64> {
    Some(line(text, name)?.trim().trim_end_matches(" kB").parse::<u64>().ok()? << 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a folder of groups from the paths and contents of files.
    fn groups(name: &str, files: &[(&str, &str)]) -> std::path::PathBuf {
        let folder = std::env::temp_dir().join(format!("gonio-groups-{}-{name}", std::process::id()));
        for (path, content) in files {
            let path = folder.join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, content).expect("a file");
        }
        folder
    }

    #[test]
    fn the_narrowest_group_counts_in_both_versions() {
        let second = groups(
            "second",
            &[
                ("job/memory.max", "1000\n"),
                ("job/memory.current", "700\n"),
                ("job/memory.stat", "anon 1\ninactive_file 100\n"),
                ("job/step/memory.max", "max\n"),
                ("job/step/memory.current", "5\n"),
            ],
        );
        assert_eq!(left_by_groups("0::/job/step\n", &second), Some(400));
        assert_eq!(left_by_groups("0::/\n", &second), None);
        let files = [("memory/memory.limit_in_bytes", "900\n"), ("memory/memory.usage_in_bytes", "200\n")];
        let first = groups("first", &files);
        assert_eq!(left_by_groups("3:cpu:/x\n2:memory,hugetlb:/docker/abc\n", &first), Some(700));
        [second, first].into_iter().for_each(|folder| fs::remove_dir_all(folder).expect("ours"));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_no_machine_has_is_refused_in_words() {
        assert!(free_memory().is_some_and(|free| free > 1 << 20));
        assert_eq!(room_for(1), Ok(()));
        let problem = room_for(1 << 60).expect_err("a billion gigabytes").to_string();
        assert!(problem.starts_with("1152921504.6 GB of memory are wanted, "), "{problem}");
    }
}
