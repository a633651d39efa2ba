//! Power and energy of a road's lighting (EN 13201-5).

use crate::{
    line::Line,
    results::{Energy, Field, Footing, Illuminances},
    road::Road,
};

/// Indicators for the carriageway and the paths beside it; none where a luminaire's power is not known.
pub(crate) fn energy(road: &Road, lines: &[Line<'_>], field: &Field, own: &Illuminances, paths: &[Footing]) -> Option<Energy> {
    let per_metre = lines.iter().map(|line| Some(line.row.power? / line.row.spacing)).sum::<Option<f64>>()?;
    let width = |path: &Footing| path.range[1] - path.range[0];
    let area = field.length * (road.carriageway_width + paths.iter().map(width).sum::<f64>());
    let of_paths: f64 = paths.iter().map(|path| width(path) * path.illuminances.e_av).sum();
    let flux = field.length * (road.carriageway_width * own.e_av + of_paths);
    let hours: f64 = road.periods.iter().map(|period| period.hours * period.level).sum();
    let power = per_metre * field.length;
    Some(Energy {
        power_w_per_km: 1000.0 * per_metre,
        pdi: (flux > 0.0).then(|| 1000.0 * power / flux),
        aeci: power * hours / area / 1000.0,
    })
}
