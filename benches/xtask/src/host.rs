//! Runs the same workload here and compares the results.

use std::collections::BTreeMap;

use attractor_workload::kernels::{self, Watch};
use attractor_workload::{Blind, scenes};

use crate::report::Report;

/// Fills in the host's checksums; a difference, or a row that is missing, is a problem.
pub(crate) fn compare(report: &mut Report) {
    let all = || scenes::TABLES.iter().flat_map(|(_, table)| *table);
    let drawn: BTreeMap<_, _> = all()
        .map(|scene| {
            let size = format!("{}x{}", scene.size.width, scene.size.height);
            ((scene.name.to_owned(), size), (scene.small, scene.run(&mut Blind)))
        })
        .collect();
    let computed: BTreeMap<_, _> = kernels::ALL
        .iter()
        .map(|kernel| {
            let tally = (kernel.fixed)(&mut Watch::new(&mut Blind, 1));
            (kernel.name, (kernel.small, tally.units, format!("{:08x}", tally.checksum)))
        })
        .collect();
    if drawn.len() < all().count() || computed.len() < kernels::ALL.len() {
        report.problems.push("two scenes or two kernels have the same name".to_owned());
    }

    for measured in &mut report.targets {
        let triple = measured.target.triple;
        for ((name, size), (small, outcome)) in &drawn {
            let row = measured.scenes.iter_mut().find(|row| row.name == *name && row.size == *size);
            match (row, outcome) {
                (Some(row), Ok(outcome)) => {
                    row.crc32_host = format!("{:08x}", outcome.crc32);
                    if row.crc32 != row.crc32_host {
                        report.problems.push(format!(
                            "scene {name} {size}: CRC {} on {triple}, {} on the host",
                            row.crc32, row.crc32_host
                        ));
                    }
                }
                (_, Err(failure)) => {
                    report.problems.push(format!("scene {name} {size} on the host: {failure}"));
                }
                (None, Ok(_)) if *small || !measured.target.small => {
                    report.problems.push(format!("scene {name} {size} was not drawn on {triple}"));
                }
                (None, Ok(_)) => {}
            }
        }
        for (name, (small, units, checksum)) in &computed {
            if *units == 0 {
                report.problems.push(format!("kernel {name} did nothing"));
            }
            match measured.kernels.iter().find(|row| row.name == *name) {
                Some(row) if row.checksum == *checksum => {}
                Some(row) => report.problems.push(format!(
                    "kernel {name}: checksum {} on {triple}, {checksum} on the host",
                    row.checksum
                )),
                None if measured.target.small && !small => {}
                None => report.problems.push(format!("kernel {name} did not run on {triple}")),
            }
        }
    }
}
