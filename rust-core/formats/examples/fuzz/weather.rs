//! EPW and WEA.

use crate::Reader;
use gonio_formats::weather::read;

/// The reader of both.
pub(crate) fn readers() -> Vec<Reader> {
    vec![Reader {
        name: "weather",
        seeds,
        read: |bytes| read(bytes).is_ok_and(|weather| weather.at(6, 21, 12.0).is_some()),
        memory: 1 << 20,
    }]
}

fn seeds() -> Vec<Vec<u8>> {
    let wea = "place here\nlatitude 50\nlongitude -8.5\ntime_zone -15\nsite_elevation 100\nweather_data_file_units 1\n6 21 12.5 700 120\n";
    let epw = "LOCATION,Here,-,-,-,0,50,8.5,1,100\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n\
        2001,6,21,13,60,?9,21,11.5,50,101300,0,0,300,800,700,120,0,0,0,0\n";
    [wea, epw].map(|text| text.as_bytes().to_vec()).into()
}
