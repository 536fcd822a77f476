use super::*;
use crate::record::PointIds;

/// A file taken apart: its XML head, and the blocks that its offsets point to.
struct Parsed {
    head: String,
    blocks: Vec<u8>,
}

impl Parsed {
    fn of(snapshot: &Snapshot<'_>, geometry: &Geometry<'_>) -> Self {
        let mut bytes = Vec::new();
        write_vtk(snapshot, geometry, &mut bytes).unwrap();
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let at = bytes.windows(mark.len()).position(|window| window == mark).unwrap();
        let tail = b"\n</AppendedData>\n</VTKFile>\n";
        assert!(bytes.ends_with(tail));
        let blocks = bytes[at + mark.len()..bytes.len() - tail.len()].to_vec();
        let parsed = Self { head: String::from_utf8(bytes[..at].to_vec()).unwrap(), blocks };
        parsed.check_that_blocks_fill_the_file();
        parsed
    }

    /// The value of an attribute in the declaration of an array.
    fn attribute(&self, name: &str, key: &str) -> String {
        let start = self.head.find(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("{name}"));
        let from = self.head[..start].rfind('<').unwrap();
        let declaration = &self.head[from..from + self.head[from..].find('>').unwrap()];
        let value = declaration.split(&format!("{key}=\"")).nth(1).unwrap();
        value.split('"').next().unwrap().to_owned()
    }

    fn words(&self, name: &str) -> Vec<u64> {
        assert_eq!(self.attribute(name, "format"), "appended");
        let offset: usize = self.attribute(name, "offset").parse().unwrap();
        let words = |bytes: &[u8]| -> Vec<u64> {
            bytes.chunks_exact(8).map(|w| u64::from_le_bytes(w.try_into().unwrap())).collect()
        };
        let length = words(&self.blocks[offset..offset + 8])[0] as usize;
        words(&self.blocks[offset + 8..offset + 8 + length])
    }

    fn floats(&self, name: &str) -> Vec<f64> {
        self.words(name).into_iter().map(f64::from_bits).collect()
    }

    fn check_that_blocks_fill_the_file(&self) {
        let mut end = 0;
        for offset in self.head.split("offset=\"").skip(1) {
            let offset: usize = offset.split('"').next().unwrap().parse().unwrap();
            assert_eq!(offset, end, "blocks follow one another");
            let length = self.blocks[offset..offset + 8].try_into().unwrap();
            end = offset + 8 + u64::from_le_bytes(length) as usize;
        }
        assert_eq!(end, self.blocks.len());
    }
}

fn points(coordinates: Option<Vec<f64>>, ids: &[u64]) -> Geometry<'_> {
    Geometry::Points(Points {
        ids: PointIds::Listed(ids.into()),
        coordinates: coordinates.map(Into::into),
        dimension: 3,
    })
}

#[test]
fn points_carry_their_fields_numbers_and_time() {
    let snapshot = Snapshot {
        time: 0.25,
        step_index: 1,
        fields: vec![
            Field::vector("slip", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "m"),
            Field::scalar("a<b & \"c\"", vec![-1.5, f64::MIN_POSITIVE], "Pa"),
        ],
    };
    let placed = points(Some(vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]), &[40, 7]);
    let parsed = Parsed::of(&snapshot, &placed);
    assert!(parsed.head.contains("type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\""));
    assert!(parsed.head.contains("header_type=\"UInt64\""));
    assert!(parsed.head.contains("NumberOfPoints=\"2\" NumberOfVerts=\"1\""));
    assert!(parsed.head.contains(">0.25</DataArray>"));
    assert!(parsed.head.contains("<PointData Scalars=\"a&lt;b &amp; &quot;c&quot;\">"));
    assert!(parsed.head.contains("location=\"vtkDataArray\">Pa</InformationKey>"));
    assert_eq!(parsed.words("point"), [40, 7]);
    assert_eq!(parsed.attribute("slip", "NumberOfComponents"), "3");
    assert_eq!(parsed.floats("slip"), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(parsed.floats("a&lt;b &amp; &quot;c&quot;"), [-1.5, f64::MIN_POSITIVE]);
    assert_eq!(parsed.floats("Points"), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!((parsed.words("connectivity"), parsed.words("offsets")), (vec![0, 1], vec![2]));
}

#[test]
fn points_without_coordinates_lie_on_a_line() {
    let snapshot = Snapshot { time: 0.0, step_index: 0, fields: Vec::new() };
    let parsed = Parsed::of(&snapshot, &points(None, &[9, 5, 1]));
    assert_eq!(parsed.floats("Points"), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let none = Parsed::of(&snapshot, &points(None, &[]));
    assert!(none.head.contains("NumberOfPoints=\"0\" NumberOfVerts=\"0\""));
    assert!(none.words("offsets").is_empty());
}

#[test]
fn a_grid_has_cell_data_over_its_extent() {
    let snapshot = Snapshot {
        time: 3.0,
        step_index: 2,
        fields: vec![Field::scalar("wear", (0..6).map(f64::from).collect::<Vec<_>>(), "m")],
    };
    let grid = Grid { cells: [3, 2], size: [3.0e-4, 1.0e-4], origin: [-1.5e-4, 0.0] };
    let parsed = Parsed::of(&snapshot, &Geometry::Grid(grid));
    assert!(parsed.head.contains("WholeExtent=\"0 3 0 2 0 0\" Origin=\"-0.00015 0.0 0\""));
    assert!(parsed.head.contains("<CellData Scalars=\"wear\">"));
    assert_eq!(parsed.floats("wear"), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let row = Grid { cells: [6, 1], size: [6.0, 0.0], origin: [0.0, 0.0] };
    let parsed = Parsed::of(&snapshot, &Geometry::Grid(row));
    assert!(parsed.head.contains("Extent=\"0 6 0 0 0 0\"") && parsed.head.contains("Spacing=\"1.0 1.0 1.0\""));
}
